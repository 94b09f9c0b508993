// SPDX-License-Identifier: GPL-3.0-or-later
// What a sweep takes.
#pragma once

#include <coagula/stages/dataset.hpp>

namespace coagula::stages {

/// Memory of the process that computes the largest structure [byte].
double bytes_of_process(const Sweep& sweep);

/// The number of processes at a time. Throws InputError where the memory is not enough for one.
int jobs_of(const Sweep& sweep, const SetRun& run);

}  // namespace coagula::stages
