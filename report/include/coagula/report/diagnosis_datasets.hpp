// SPDX-License-Identifier: GPL-3.0-or-later
// diagnosis.h5: everything behind a diagnosis, each data set with unit and description.
#pragma once

#include <coagula/report/diagnosis_page.hpp>
#include <coagula/report/results.hpp>

namespace coagula::report {

/// Data sets of the group /diagnosis, and the provenance of the run.
Results datasets_of(const DiagnosisRecord& record);

}  // namespace coagula::report
