// SPDX-License-Identifier: GPL-3.0-or-later
// A table that lies far off its replicates as a whole: that is an error of this table, not noise.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <string>
#include <vector>

namespace coagula::diagnose {

struct LoneTable {
    std::string label;
    std::string sample;
    std::string observable;   ///< "complex_modulus", "phase" or the name of the one quantity of the table
    double difference = 0;    ///< from the others: a factor, of a phase an angle [rad]
    bool one_of_two = false;  ///< nobody knows which of two is wrong
    std::string other = {};   ///< label of the other one of two
};

/// For every kind of replicates and each of their quantities the table that lies farthest off the median of the others, where it
/// does so by more than a factor of 2, or 0.03 rad, and six times farther than the others lie apart; one of two by a factor of 3,
/// or 0.1 rad. Else the sample of three or more whose level would lie as far off the others by chance in less than one of 20
/// experiments, where samples differ by a tenth, known to a factor of e. Levels are medians over the rows that all tables have.
std::vector<LoneTable> lone_tables(const std::vector<Measurement>& tables);

}  // namespace coagula::diagnose
