// SPDX-License-Identifier: GPL-3.0-or-later
// Results of `coagula diagnose`: diagnosis.json and a table.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/report/results.hpp>

#include <functional>
#include <string>
#include <vector>

namespace coagula::report {

/// Errors of some tables, from replicates or statements.
Json noise_json(const diagnose::NoiseModel& noise);

/// The object of diagnosis.json. @param noise of the tables. @param model path of the extended model; empty: there is none.
Json to_json(const diagnose::Diagnosis& diagnosis, const std::vector<diagnose::NoiseModel>& noise, const std::string& model);

Table table_of(const diagnose::Diagnosis& diagnosis);

/// Change of the log predictive density on held-out rows: "+12.3 (90 % interval 8.1 to 17)". There must be such rows.
std::string change_of_density(const diagnose::Gain& gain, const std::function<std::string(double)>& print);

/// No data set drawn from the base model has a misfit as large, so that p is at most what is stated.
bool is_least_p(const diagnose::Diagnosis& diagnosis);

}  // namespace coagula::report
