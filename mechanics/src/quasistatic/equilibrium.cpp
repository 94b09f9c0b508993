// SPDX-License-Identifier: GPL-3.0-or-later
#include "equilibrium.hpp"

#include "residual_minimisation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace coagula::mechanics {

namespace {

constexpr double rounding_of_forces = 5e-15;  // of forces, in contact stiffnesses times mean radii
constexpr int most_newton_iterations = 25;
constexpr int most_krylov_iterations = 60;
constexpr double predictor_tolerance = 1e-6;
constexpr double krylov_tolerance = 1e-2;
constexpr int stale_iterations = 15;   // beyond these a new factor is cheaper
constexpr double longest_step = 0.05;  // of a particle in one iteration, in mean radii and radians
constexpr int most_descents = 300;
constexpr double least_damping = 1e-8;  // in contact stiffnesses
constexpr double most_damping = 10;
constexpr int most_corrections = 30;
constexpr std::size_t trust = 8;     // corrections within which they must halve
constexpr int most_updates = 10;     // of the factor, before the contacts are left as they are
constexpr int easy_corrections = 4;  // solutions with a good factor
constexpr int worth_a_factor = 60;   // a factorisation takes as long as some 50 solutions
constexpr std::size_t patience = 4;  // Newton iterations within which the correction must halve

double longest(const Motion& motion) {
    return motion.size() == 0 ? 0.0 : motion.cwiseAbs().maxCoeff();
}

/// Improves each correction by those before it so that what is left of their linear model is least (Anderson 1965; Walker and Ni,
/// SIAM J. Numer. Anal. 49 (2011) 1715).
class Acceleration {
public:
    Motion step(const Motion& correction) const {
        Motion all = correction;
        for (std::size_t k = 0; k < moved_.size(); ++k) {
            all -= change_[k].dot(correction) * (moved_[k] + change_[k]);
        }
        return all;
    }
    /// @param change of the correction by the motion.
    void learn(Motion motion, Motion change) {
        for (std::size_t k = 0; k < moved_.size(); ++k) {
            const double share = change_[k].dot(change);
            change -= share * change_[k];
            motion -= share * moved_[k];
        }
        const double length = change.norm();
        if (length > 0) {
            change_.emplace_back(change / length);
            moved_.emplace_back(motion / length);
        }
    }

private:
    std::vector<Motion> moved_;
    std::vector<Motion> change_;  // orthonormal
};

}  // namespace

/// Forces are measured by the largest of the run so far: near zero strain there is next to none.
bool EquilibriumSolver::is_balanced(const Trial& trial) {
    const double scale = std::max(trial.rms_force, largest_force_);
    const bool balanced = trial.rms_residual <= std::max(tolerance_ * scale, rounding_of_forces);
    if (balanced) {
        largest_force_ = scale;
    }
    return balanced;
}

void EquilibriumSolver::factorise(const ShearedNetwork& network, const Trial& trial, double damping) {
    factor_.reset();  // two would need twice the memory
    factor_ = std::make_unique<UpdatedFactor>(network, trial, damping);
    effort_.factorisations += factor_->factorisations();
    fresh_ = true;
    wasted_ = 0;
}

/// Brings the factor up to date with the contacts that open, close, slip or are broken. Returns whether anything has changed.
bool EquilibriumSolver::refresh(const ShearedNetwork& network, const Trial& trial) {
    if (!factor_ || factor_->generation() != network.generation() || factor_->is_full() || wasted_ > worth_a_factor) {
        factorise(network, trial);
        return true;
    }
    return factor_->update(network, trial);
}

Motion EquilibriumSolver::precondition(const Motion& load) {
    ++effort_.solutions;
    ++last_solutions_;
    return factor_->solve(load);
}

/// @param correction P^-1 residual; renewed with the factor.
std::optional<Motion> EquilibriumSolver::newton_step(const ShearedNetwork& network, const Trial& trial, Motion& correction) {
    const StiffnessOfContacts stiffness(network, trial);
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!factor_ || (attempt > 0 && !fresh_)) {
            factorise(network, trial);
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
    const StiffnessOfContacts stiffness(network, rest);
    factorise(network, rest);
    return minimise_residual([&](const Motion& motion) { return precondition(stiffness * motion); },
                             precondition(stiffness.strain_load()), predictor_tolerance, most_krylov_iterations)
        .solution;
}

/// Corrections with the factor at hand, accelerated. Returns whether it came to balance; else `trial` is the best.
bool EquilibriumSolver::correct(const ShearedNetwork& network, Trial& trial) {
    Acceleration acceleration;
    Trial now = trial;
    Motion correction = precondition(now.residual);
    std::vector<double> left{correction.norm()};
    double least = left.front();
    int updates = 0;
    for (int iteration = 0; iteration < most_corrections; ++iteration) {
        const Motion step = acceleration.step(correction);
        if (!(longest(step) <= longest_step)) {
            return false;
        }
        ++effort_.evaluations;
        network.evaluate(trial.strain_increment, Motion(now.motion + step), now);
        if (is_balanced(now)) {
            trial = std::move(now);
            return true;
        }
        if (!std::isfinite(now.rms_residual)) {
            return false;
        }
        const Motion before = correction;
        correction = precondition(now.residual);
        left.push_back(correction.norm());
        if (left.size() > trust && !(left.back() < 0.5 * left[left.size() - 1 - trust])) {
            return false;
        }
        if (updates < most_updates && refresh(network, now)) {
            ++updates;
            acceleration = {};
            correction = precondition(now.residual);
        } else {
            acceleration.learn(step, correction - before);
        }
        if (left.back() < least) {
            least = left.back();
            trial = now;
        }
    }
    return false;
}

bool EquilibriumSolver::find(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial) {
    last_solutions_ = 0;
    fresh_ = false;
    ++effort_.evaluations;
    network.evaluate(strain_increment, start, trial);
    if (is_balanced(trial) || !std::isfinite(trial.rms_residual)) {
        last_residual_ = trial.rms_residual;
        return is_balanced(trial);
    }
    refresh(network, trial);
    if (!correct(network, trial) && !follow_newton(network, trial)) {
        return false;
    }
    last_residual_ = trial.rms_residual;
    wasted_ += std::max(0, last_solutions_ - easy_corrections);
    return true;
}

bool EquilibriumSolver::follow_newton(const ShearedNetwork& network, Trial& trial) {
    Motion correction;
    std::vector<double> left;
    for (int iteration = 0; iteration < most_newton_iterations; ++iteration) {
        last_residual_ = trial.rms_residual;
        if (is_balanced(trial) || !std::isfinite(trial.rms_residual)) {
            return is_balanced(trial);
        }
        if (refresh(network, trial) || correction.size() == 0) {
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

/// The way down of particles in a liquid, by one implicit step as long as the inverse of the damping; without damping Newton's
/// direction. Where the stiffness is not convex, that of the preconditioner, which always leads down.
Motion EquilibriumSolver::downhill(const ShearedNetwork& network, const Trial& trial, double damping) {
    const StiffnessOfContacts stiffness(network, trial);
    factorise(network, trial, damping);
    const Motion correction = precondition(trial.residual);
    Motion step = correction;
    if (factor_->is_convex()) {
        const auto damped = [&](const Motion& motion) { return precondition(stiffness * motion + damping * motion); };
        const KrylovSolution newton = minimise_residual(damped, correction, krylov_tolerance, stale_iterations);
        step = trial.residual.dot(newton.solution) > 0 ? newton.solution : correction;
    }
    return std::min(1.0, longest_step / std::max(longest(step), 1e-300)) * step;
}

/// Shortens a step that leads down until the energy falls enough. Returns the share of it, 0 where it falls nowhere.
double EquilibriumSolver::descend(const ShearedNetwork& network, const Motion& step, Trial& trial) {
    constexpr int most_trials = 12;
    constexpr double shorter = 0.3;
    const double energy = network.reduced_energy(trial);
    const double slope = trial.residual.dot(step);
    double share = 1;
    for (int attempt = 0; attempt < most_trials; ++attempt, share *= shorter) {
        Trial next;
        ++effort_.evaluations;
        network.evaluate(trial.strain_increment, trial.motion + share * step, next);
        const double reached = network.reduced_energy(next);
        if (reached <= energy - 1e-4 * share * slope && reached < energy) {
            trial = std::move(next);
            return share;
        }
    }
    return 0;
}

/// Contacts that open and close cut steps short. Damping shortens them too, but the contacts that bear now then hardly change, so
/// that many steps come farther (pseudo-transient continuation: Kelley and Keyes, SIAM J. Numer. Anal. 35 (1998) 508).
bool EquilibriumSolver::minimise(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial,
                                 const Progress& progress) {
    network.evaluate(strain_increment, start, trial);
    if (!std::isfinite(network.reduced_energy(trial))) {
        return false;
    }
    double damping = 0;
    for (int iteration = 0; iteration < most_descents && damping < most_damping; ++iteration) {
        progress.update("looking for another equilibrium", static_cast<double>(iteration) / most_descents);
        const double share = descend(network, downhill(network, trial, damping), trial);
        if (share < 0.1) {
            damping = std::max(10 * damping, least_damping);
        } else if (share > 0.5) {
            damping = damping > least_damping ? 0.1 * damping : 0.0;
        }
        if (network.reach_used(strain_increment, trial.motion) > 1) {
            return false;
        }
        Trial found;
        if ((share == 0 || iteration % 3 == 2) && find(network, strain_increment, trial.motion, found)) {
            trial = std::move(found);
            return true;
        }
    }
    return false;
}

}  // namespace coagula::mechanics
