// SPDX-License-Identifier: GPL-3.0-or-later
// The progress of one part of a job as progress of the whole job.
#pragma once

#include <coagula/common/progress.hpp>

#include <string>

namespace coagula::stages {

/// Reports fractions of the part as such of the whole, of which the part is number `number` (from 0) of `count` equal ones, under
/// the name `stage`; never less than before. The remark is `label`, and what the part says of itself. `whole` must outlive it.
Progress part_of(const Progress& whole, std::string stage, std::size_t number, std::size_t count, std::string label);

/// "orientation 2 of 6".
std::string counted(const std::string& what, std::size_t number, std::size_t count);

}  // namespace coagula::stages
