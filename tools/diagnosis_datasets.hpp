// diagnosis.h5: everything behind a diagnosis, each data set with unit and description.
#pragma once

#include "diagnosis_page.hpp"
#include "report.hpp"

namespace coagula::tools {

/// Data sets of the group /diagnosis, and the provenance of the run.
Results datasets_of(const DiagnosisRecord& record);

}  // namespace coagula::tools
