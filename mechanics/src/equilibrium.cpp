#include "equilibrium.hpp"

#include "blas_threads.hpp"
#include "residual_minimisation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace coagula::mechanics {

namespace {

constexpr int blas_threads = 1;          // the bits of a factor depend on it; a solution with one load gains nothing from more
constexpr double smallest_shift = 1e-8;  // of the preconditioner, in contact stiffnesses
constexpr double largest_shift = 10;
constexpr double rounding = 5e-15;  // of forces, in contact stiffnesses times mean radii
constexpr int most_newton_iterations = 25;
constexpr int most_krylov_iterations = 60;
constexpr double predictor_tolerance = 1e-6;
constexpr double krylov_tolerance = 1e-2;
constexpr int stale_iterations = 15;   // beyond these a new factor is cheaper
constexpr double longest_step = 0.05;  // of a particle in one iteration, in mean radii and radians
constexpr int most_descents = 300;
constexpr std::size_t patience = 4;  // Newton iterations within which the correction must halve

double longest(const Motion& motion) {
    return motion.size() == 0 ? 0.0 : motion.cwiseAbs().maxCoeff();
}

}  // namespace

/// Forces are measured by the largest of the run so far: near zero strain there is next to none.
bool EquilibriumSolver::is_balanced(const Trial& trial) {
    const double scale = std::max(trial.rms_force, largest_force_);
    const bool balanced = trial.rms_residual <= std::max(tolerance_ * scale, rounding);
    if (balanced) {
        largest_force_ = scale;
    }
    return balanced;
}

/// Factor of the symmetric part with the smallest shift that makes it positive definite.
void EquilibriumSolver::factorise(const BlockMatrix& stiffness, double least_shift) {
    const BlasThreads threads(blas_threads);
    const EliminationOrder order(stiffness, Ordering::nested_dissection);
    for (shift_ = least_shift;; shift_ *= 10) {
        ++effort_.factorisations;
        try {
            factor_ = std::make_unique<CholeskyFactor>(stiffness, shift_, order);
            break;
        } catch (const NotPositiveDefinite&) {
            if (shift_ > largest_shift) {
                throw;
            }
        }
    }
    fresh_ = true;
}

Motion EquilibriumSolver::precondition(const Motion& load) {
    const BlasThreads threads(blas_threads);
    ++effort_.solutions;
    ++last_solutions_;
    Motion motion;
    factor_->solve(load, motion);
    return motion;
}

/// @param correction P^-1 residual; renewed with the factor.
std::optional<Motion> EquilibriumSolver::newton_step(const ShearedNetwork& network, const Trial& trial, Motion& correction) {
    const ContactStiffness stiffness(network, trial);
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!factor_ || (attempt > 0 && !fresh_)) {
            factorise(stiffness.symmetric_part(), smallest_shift);
            correction = precondition(trial.residual);
        }
        const KrylovSolution solution =
            minimise_residual([&](const Motion& motion) { return precondition(stiffness * motion); }, correction, krylov_tolerance,
                              fresh_ ? most_krylov_iterations : stale_iterations);
        if (solution.residual <= krylov_tolerance || (fresh_ && solution.residual < 0.9)) {
            return solution.solution;
        }
    }
    return std::nullopt;
}

/// Natural monotonicity test (Deuflhard, Newton Methods for Nonlinear Problems, 2004, sec. 3.3): the correction that is left must
/// shrink. The residual itself would not: soft modes move far, and stretch stiff bonds to second order on the way.
bool EquilibriumSolver::search_line(const ShearedNetwork& network, const Motion& step, Trial& trial, Motion& correction) {
    const Motion start = trial.motion;
    const double before = correction.norm();
    double share = std::min(1.0, longest_step / std::max(longest(step), 1e-300));
    Trial next;
    for (int attempt = 0; attempt < 8; ++attempt, share *= 0.5) {
        ++effort_.evaluations;
        network.evaluate(trial.strain_increment, start + share * step, next);
        const Motion left = precondition(next.residual);
        if (left.norm() < (1 - 0.25 * share) * before || is_balanced(next)) {
            trial = std::move(next);
            correction = left;
            return true;
        }
    }
    return false;
}

Motion EquilibriumSolver::predict(const ShearedNetwork& network, const Trial& rest) {
    const ContactStiffness stiffness(network, rest);
    factorise(stiffness.symmetric_part(), smallest_shift);
    return minimise_residual([&](const Motion& motion) { return precondition(stiffness * motion); },
                             precondition(stiffness.strain_load()), predictor_tolerance, most_krylov_iterations)
        .solution;
}

bool EquilibriumSolver::find(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial) {
    last_solutions_ = 0;
    fresh_ = false;
    ++effort_.evaluations;
    network.evaluate(strain_increment, start, trial);
    Motion correction;
    std::vector<double> left;
    for (int iteration = 0; iteration < most_newton_iterations; ++iteration) {
        last_residual_ = trial.rms_residual;
        if (is_balanced(trial) || !std::isfinite(trial.rms_residual)) {
            return is_balanced(trial);
        }
        if (factor_ && correction.size() == 0) {
            correction = precondition(trial.residual);
        }
        const auto step = newton_step(network, trial, correction);
        left.push_back(correction.norm());
        if (left.size() > patience && left.back() > 0.5 * left[left.size() - 1 - patience]) {
            return false;
        }
        if (!step || !search_line(network, *step, trial, correction)) {
            if (fresh_ || !factor_) {
                return false;
            }
            factor_.reset();
            continue;
        }
        fresh_ = false;
    }
    return is_balanced(trial);
}

/// Newton's direction where it leads down, else that of the preconditioner, which always does.
Motion EquilibriumSolver::downhill(const ShearedNetwork& network, const Trial& trial) {
    const ContactStiffness stiffness(network, trial);
    if (!factor_ || !fresh_) {
        factorise(stiffness.symmetric_part(), smallest_shift);
    }
    const Motion correction = precondition(trial.residual);
    Motion step = correction;
    if (shift_ <= smallest_shift) {
        const KrylovSolution newton = minimise_residual([&](const Motion& motion) { return precondition(stiffness * motion); },
                                                        correction, krylov_tolerance, stale_iterations);
        step = trial.residual.dot(newton.solution) > 0 ? newton.solution : correction;
    }
    return std::min(1.0, longest_step / std::max(longest(step), 1e-300)) * step;
}

bool EquilibriumSolver::minimise(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial,
                                 const Progress& progress) {
    network.evaluate(strain_increment, start, trial);
    double energy = network.reduced_energy(trial);
    if (!std::isfinite(energy)) {
        return false;
    }
    for (int iteration = 0; iteration < most_descents; ++iteration) {
        progress.update("looking for another equilibrium", static_cast<double>(iteration) / most_descents);
        fresh_ = false;
        Motion step = downhill(network, trial);
        const double slope = trial.residual.dot(step);
        bool accepted = false;
        for (int attempt = 0; attempt < 12 && !accepted; ++attempt, step *= 0.3) {
            Trial next;
            ++effort_.evaluations;
            network.evaluate(strain_increment, trial.motion + step, next);
            const double reached = network.reduced_energy(next);
            accepted = reached <= energy - 1e-4 * std::pow(0.3, attempt) * slope && reached < energy;
            if (accepted) {
                energy = reached;
                trial = std::move(next);
            }
        }
        if (network.reach_used(strain_increment, trial.motion) > 1) {
            return false;
        }
        Trial found;
        if ((!accepted || iteration % 3 == 2) && find(network, strain_increment, trial.motion, found)) {
            trial = std::move(found);
            return true;
        }
        if (!accepted) {
            return false;
        }
    }
    return false;
}

}  // namespace coagula::mechanics
