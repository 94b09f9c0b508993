// SPDX-License-Identifier: GPL-3.0-or-later
#include "conjugate_gradients.hpp"

#include "column_sums.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <string>

namespace coagula::mechanics {

namespace {

using Row = SixValues<double>;

constexpr double rounding = 1e-13;
constexpr std::size_t delay = 20;  // iterations whose gain estimates the error before them

/// Quotient where the column is still being solved, zero where it has ended.
Row quotient(const Row& numerator, const Row& denominator, const Eigen::Array<bool, 1, 6>& open) {
    return (open && denominator > 0).select(numerator / denominator, 0.0);
}

/// Gains of energy of the last iterations.
class EnergyError {
public:
    void add(const Row& gain) {
        recent_.push_back(gain);
        sum_ += gain;
        total_ += gain;
        if (recent_.size() > delay) {
            sum_ -= recent_.front();
            recent_.pop_front();
        }
    }
    /// Relative to the energy left, per column; infinite until enough iterations have passed.
    Row estimate(const Row& affine_energy) const {
        if (recent_.size() < delay) {
            return Row::Constant(std::numeric_limits<double>::infinity());
        }
        return sum_.max(0.0) / (affine_energy - total_).max(1e-300);
    }

private:
    std::deque<Row> recent_;
    Row sum_ = Row::Zero();
    Row total_ = Row::Zero();
};

}  // namespace

Solution conjugate_gradients(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
                             const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule,
                             const Progress& progress) {
    const Row affine = affine_energy.transpose().array();
    const Row plain_norm = dot(f, f).sqrt();
    // Loads that symmetry cancels down to rounding errors are no loads.
    const Row norm = (plain_norm > rounding * affine.sqrt()).select(plain_norm, 0.0);
    Solution solution;
    Loads& x = solution.motion;
    x = Loads::Zero(f.rows(), 6);
    Loads r = f;
    Loads z;
    precondition(r, z);
    Loads d = z;
    Loads q;
    Row rz = dot(r, z);
    EnergyError error;
    Eigen::Array<bool, 1, 6> open = norm > 0;
    while (open.any() && solution.iterations < rule.most_iterations) {
        multiply(full, d, q);
        const Row alpha = quotient(rz, dot(d, q), open);
        add_scaled(x, d, alpha);
        add_scaled(r, q, -alpha);
        ++solution.iterations;
        error.add(alpha * rz);
        const Row residual = (norm > 0).select(dot(r, r).sqrt() / norm, 0.0);
        open = open && residual > rule.residual && error.estimate(affine) > rule.energy && alpha > 0;
        progress.update("solving", 0.5, "residual " + std::to_string(std::log10(residual.maxCoeff())).substr(0, 5) + " (log10)");
        if (open.any()) {
            precondition(r, z);
            const Row next = dot(r, z);
            scale_and_add(d, quotient(next, rz, open), z);
            rz = next;
        }
    }
    multiply(full, x, q);
    q = f - q;
    const Row residual = (norm > 0).select(dot(q, q).sqrt() / norm, 0.0);
    solution.residual = residual.maxCoeff();
    solution.energy_error = error.estimate(affine).maxCoeff();
    solution.converged = (residual <= 2 * rule.residual || error.estimate(affine) <= rule.energy).all();
    return solution;
}

}  // namespace coagula::mechanics
