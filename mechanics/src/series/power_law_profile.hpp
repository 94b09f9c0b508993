// SPDX-License-Identifier: GPL-3.0-or-later
// Sum of squares of the power law with c and beta eliminated, as a function of a0 alone.
#pragma once

#include <coagula/mechanics/power_law.hpp>

#include <string>

namespace coagula::mechanics {

/// Why the data cannot be fitted, one sentence; empty when they can.
std::string objection_to(const PowerLawData& data);

class ProfiledSquares {
public:
    /// @param data such that there is no objection to them.
    explicit ProfiledSquares(const PowerLawData& data);

    double smallest_a() const { return a_[0]; }
    /// Largest a less the smallest.
    double range() const { return a_[a_.size() - 1] - a_[0]; }
    /// Weighted least squares over c and beta.
    PowerLaw best_at(double a0) const;

private:
    struct Elimination;

    Eigen::VectorXd a_;        // rising, each value once
    Eigen::VectorXd modulus_;  // weighted mean of the structures with this a
    Eigen::VectorXd weight_;   // sum of theirs
    double scatter_ = 0;       // sum of squares among structures of equal a, which no law removes
};

}  // namespace coagula::mechanics
