// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the motion after which every particle of a sheared network is in balance.
#pragma once

#include "sheared_network.hpp"
#include "stiffness_of_contacts.hpp"
#include "updated_factor.hpp"

#include <coagula/common/progress.hpp>

#include <memory>
#include <optional>

namespace coagula::mechanics {

class EquilibriumSolver {
public:
    EquilibriumSolver(double tolerance, SolverEffort& effort) : tolerance_(tolerance), effort_(effort) {}

    /// Motion per strain of the linear response at the committed equilibrium `rest`.
    Motion predict(const ShearedNetwork& network, const Trial& rest);

    /// Newton's method from the motion given, at this strain increment. Returns whether `trial` is an equilibrium.
    bool find(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial);

    /// Goes down in energy to an equilibrium, as strongly damped particles would. Where it returns false, `trial` is how far it
    /// came.
    bool minimise(const ShearedNetwork& network, double strain_increment, const Motion& start, Trial& trial,
                  const Progress& progress);

    /// Solutions with a factor in the last `find`.
    int last_solutions() const { return last_solutions_; }
    double last_residual() const { return last_residual_; }

private:
    bool is_balanced(const Trial& trial);
    void factorise(const ShearedNetwork& network, const Trial& trial, double damping = 0);
    bool refresh(const ShearedNetwork& network, const Trial& trial);
    Motion precondition(const Motion& load);
    std::optional<Motion> newton_step(const ShearedNetwork& network, const Trial& trial, Motion& correction);
    Motion downhill(const ShearedNetwork& network, const Trial& trial, double damping);
    double descend(const ShearedNetwork& network, const Motion& step, Trial& trial);
    bool correct(const ShearedNetwork& network, Trial& trial);
    bool follow_newton(const ShearedNetwork& network, Trial& trial);
    bool search_line(const ShearedNetwork& network, const Motion& step, Trial& trial, Motion& correction);

    double tolerance_;
    double largest_force_ = 0;  ///< rms over the contacts, of the equilibria so far
    SolverEffort& effort_;
    std::unique_ptr<UpdatedFactor> factor_;
    bool fresh_ = false;  ///< the factor belongs to the present state
    int wasted_ = 0;      ///< solutions that a better factor would have spared
    int last_solutions_ = 0;
    double last_residual_ = 0;
};

}  // namespace coagula::mechanics
