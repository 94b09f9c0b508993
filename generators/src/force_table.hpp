// SPDX-License-Identifier: GPL-3.0-or-later
// A force by the distance as a table of cubics: what the pair loop evaluates instead of the laws.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace coagula::generators {

/// Force over distance of two spheres of radius 1, as cubics on equal intervals of the squared distance: no root and no division is
/// needed. Below the first knot the first cubic goes on, above the last knot the force is zero.
class ForceTable {
public:
    /// Each cubic meets the force in four points of its interval, so that the table is continuous and a kink of the force in a knot
    /// stays one.
    /// @param force by the gap; zero at and beyond `last`. @param first gap from which on the table is made.
    /// @param knot a gap that becomes a knot, `first` <= `knot` < `last`. @param spacing of the knots, as gap near contact.
    ForceTable(const std::function<double(double)>& force, double first, double knot, double last, double spacing);

    double force(double gap) const;
    double last() const { return last_; }
    double first_squared() const { return first_squared_; }
    double inverse_spacing() const { return inverse_spacing_; }
    /// Intervals with a force; one more follows where it is zero.
    std::size_t intervals() const { return intervals_; }
    /// Four coefficients for each interval, lowest power first, of the place in the interval (0 to 1).
    const double* coefficients() const { return coefficients_.data(); }

private:
    double last_;             ///< gap
    double first_squared_;    ///< distance
    double inverse_spacing_;  ///< of the squared distance
    std::size_t intervals_;
    std::vector<double> coefficients_;
};

/// Falls from 1 at `start` to 0 at `end` with zero slope at both.
double smooth_switch(double gap, double start, double end);

}  // namespace coagula::generators
