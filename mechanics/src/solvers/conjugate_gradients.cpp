// SPDX-License-Identifier: GPL-3.0-or-later
#include "conjugate_gradients.hpp"

#include "column_sums.hpp"
#include "energy_error.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <string>

namespace coagula::mechanics {

namespace {

using Row = EnergyError::Row;
using Columns = EnergyError::Columns;

constexpr double dependent = 1e-10;  // share of energy below which a direction is a combination of the others

/// Pseudo-inverse of P^T K P. Directions that depend on each other count once; those without positive energy (of rounding errors,
/// or where K is not positive definite) do not count.
Block inverse_energies(const Block& energies) {
    const Eigen::Matrix<double, 6, 1> scale =
        energies.diagonal().unaryExpr([](double energy) { return energy > 0 ? 1 / std::sqrt(energy) : 0.0; });
    const Eigen::SelfAdjointEigenSolver<Block> modes(scale.asDiagonal() * energies * scale.asDiagonal());
    const Eigen::Matrix<double, 6, 1> inverse =
        modes.eigenvalues().unaryExpr([](double value) { return value > dependent ? 1 / value : 0.0; });
    return scale.asDiagonal() * modes.eigenvectors() * inverse.asDiagonal() * modes.eigenvectors().transpose() * scale.asDiagonal();
}

/// `factor` with the columns that have ended set to zero.
Block only(const Block& factor, const Columns& open) {
    return factor * open.cast<double>().matrix().asDiagonal();
}

/// Quotient where the column is still being solved, zero where it has ended.
Row quotient(const Row& numerator, const Row& denominator, const Columns& open) {
    return (open && denominator > 0).select(numerator / denominator, 0.0);
}

/// Checks the motion: its residual by K, the error of the energy, and whether every load has met one of the rules.
void assess(const BlockMatrix& full, const Loads& f, const Row& norm, const Row& energy_error, const StopRule& rule,
            Solution& solution) {
    Loads q;
    multiply(full, solution.motion, q);
    q = f - q;
    const Columns loaded = norm > 0;
    const Row residual = loaded.select(dot(q, q).sqrt() / norm, 0.0);
    const Row error = loaded.select(energy_error, 0.0);
    solution.residual = residual.maxCoeff();
    solution.energy_error = error.maxCoeff();
    solution.converged = (residual <= 2 * rule.residual || error <= rule.energy).all();
}

/// Each load moves along its own direction: plain conjugate gradients.
class OwnDirections {
public:
    void begin(const Loads& r, Loads& d, const Columns& /*open*/) { rz_ = dot(r, d); }

    /// Moves x along the directions d to the least energy, q = K d. Returns what each load gains.
    Row advance(Loads& x, Loads& r, const Loads& d, const Loads& q, const Columns& open) {
        const Row alpha = quotient(rz_, dot(d, q), open);
        add_scaled(x, d, alpha);
        add_scaled(r, q, -alpha);
        return (alpha > 0).select(alpha * rz_, 0.0);
    }
    /// Next directions from z, the residual as the preconditioner solves it.
    void turn(Loads& d, const Loads& /*q*/, const Loads& r, const Loads& z, const Columns& open) {
        const Row next = dot(r, z);
        scale_and_add(d, quotient(next, rz_, open), z);
        rz_ = next;
    }

private:
    Row rz_;
};

/// Each load moves along the directions of all: block conjugate gradients.
class SharedDirections {
public:
    static void begin(const Loads& /*r*/, Loads& d, const Columns& open) { d = d * open.cast<double>().matrix().asDiagonal(); }

    /// Moves x to the least energy in the space of all directions d, q = K d. Returns what each load gains.
    Row advance(Loads& x, Loads& r, const Loads& d, const Loads& q, const Columns& open) {
        inverse_ = inverse_energies(products(d, q));
        const Block work = products(d, r);
        const Block alpha = only(inverse_ * work, open);
        add_product(x, d, alpha);
        add_product(r, q, -alpha);
        return alpha.cwiseProduct(work).colwise().sum().array();
    }
    void turn(Loads& d, const Loads& q, const Loads& /*r*/, const Loads& z, const Columns& open) {
        replace_by_sum(d, only(-inverse_ * products(q, z), open), z, open.cast<double>());
    }

private:
    Block inverse_;
};

template <class Directions>
Solution solve(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
               const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule, const Progress& progress) {
    const Row affine = affine_energy.transpose().array();
    const Row plain_norm = dot(f, f).sqrt();
    // Loads that symmetry cancels down to rounding errors are no loads. Where it cancels them down to the digits of a file, their
    // sum, which no stiffness resists, is a rounding error that counts beside the rest.
    const Row norm = (plain_norm > EnergyError::rounding * affine.sqrt()).select(plain_norm.max(least_load * affine.sqrt()), 0.0);
    Columns open = norm > 0;
    Solution solution;
    Loads& x = solution.motion;
    x = Loads::Zero(f.rows(), 6);
    Loads r = f;
    Loads z;
    precondition(r, z);
    Loads d = z;
    Loads q;
    Directions directions;
    directions.begin(r, d, open);
    EnergyError error(affine);
    while (open.any() && solution.iterations < rule.most_iterations) {
        multiply(full, d, q);
        const Row gain = directions.advance(x, r, d, q, open);
        ++solution.iterations;
        error.add(gain, open);
        const Row residual = (norm > 0).select(dot(r, r).sqrt() / norm, 0.0);
        open = open && residual > rule.residual && error.estimate() > rule.energy && gain > 0;
        progress.update("solving", 0.5, "residual " + std::to_string(std::log10(residual.maxCoeff())).substr(0, 5) + " (log10)");
        if (open.any()) {
            precondition(r, z);
            directions.turn(d, q, r, z, open);
        }
    }
    assess(full, f, norm, error.estimate(), rule, solution);
    return solution;
}

}  // namespace

Solution conjugate_gradients(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
                             const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule,
                             const Progress& progress) {
    return solve<OwnDirections>(full, f, affine_energy, precondition, rule, progress);
}

Solution block_conjugate_gradients(const BlockMatrix& full, const Loads& f, const Eigen::Matrix<double, 6, 1>& affine_energy,
                                   const std::function<void(const Loads&, Loads&)>& precondition, const StopRule& rule,
                                   const Progress& progress) {
    return solve<SharedDirections>(full, f, affine_energy, precondition, rule, progress);
}

}  // namespace coagula::mechanics
