// What `coagula diagnose` finds: diagnosis.json and a table.
#pragma once

#include "report.hpp"

#include <coagula/diagnose/diagnosis.hpp>

namespace coagula::tools {

/// The object of diagnosis.json. @param model path of the extended model; empty: there is none.
Json to_json(const diagnose::Diagnosis& diagnosis, const std::string& model);

Table table_of(const diagnose::Diagnosis& diagnosis);

}  // namespace coagula::tools
