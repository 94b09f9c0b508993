// A force by the gap as a table of cubics: what the pair loop evaluates instead of the laws.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace coagula::generators {

/// Cubics on equal intervals of the gap. Below the first knot the first cubic goes on, above the last knot the force is zero.
class ForceTable {
public:
    /// Each cubic meets the force in four points of its interval, so that the table is continuous and a kink of the force in a knot
    /// stays one. @param first the first knot. The force must be zero at and beyond `last`.
    ForceTable(const std::function<double(double)>& force, double first, double last, double spacing);

    double force(double gap) const;
    double first() const { return first_; }
    double last() const { return last_; }
    double inverse_spacing() const { return inverse_spacing_; }
    /// Intervals with a force; one more follows where it is zero.
    std::size_t intervals() const { return intervals_; }
    /// Four coefficients for each interval, lowest power first, of the place in the interval (0 to 1).
    const double* coefficients() const { return coefficients_.data(); }

private:
    double first_;
    double last_;
    double inverse_spacing_;
    std::size_t intervals_;
    std::vector<double> coefficients_;
};

/// Falls from 1 at `start` to 0 at `end` with zero slope at both.
double smooth_switch(double gap, double start, double end);

}  // namespace coagula::generators
