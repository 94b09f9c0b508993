// SPDX-License-Identifier: GPL-3.0-or-later
// Charts of the index of a data set.
#pragma once

#include <coagula/io/set_file.hpp>
#include <coagula/report/chart.hpp>
#include <coagula/stages/arguments.hpp>

namespace coagula::stages {

/// Two columns as points: a series for each value of the column --colour, a panel for each of --facet. Rows in which a value is
/// missing are left out. Throws InputError for a column that the set does not have or that cannot be drawn.
report::Drawing drawing_of_set(const Arguments& arguments, const io::SetHead& set);

}  // namespace coagula::stages
