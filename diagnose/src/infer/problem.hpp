// SPDX-License-Identifier: GPL-3.0-or-later
// A model gives the density of the data, an engine draws from the posterior, and neither knows the other.
#pragma once

#include "noise/prediction.hpp"

#include <coagula/diagnose/mechanism.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace coagula::diagnose {

/// A problem has parameters, of which every place 0 .. 1 is equally probable beforehand, and data that tell more of them.
struct Problem {
    std::vector<MechanismParameter> priors;  ///< the stiffness first
    std::function<Prediction(const Eigen::VectorXd& place)> predict;
    /// Logarithm of the density of the data, and of what else is known of the parameters.
    std::function<double(const Eigen::VectorXd& place)> log_density;

    /// Values of the parameters at a place.
    Eigen::VectorXd values_at(const Eigen::VectorXd& place) const {
        return Eigen::VectorXd::NullaryExpr(
            place.size(), [&](Eigen::Index axis) { return priors[static_cast<std::size_t>(axis)].at(place[axis]); });
    }
};

/// Equally probable values of the parameters, one draw per column.
using PosteriorDraws = Eigen::MatrixXd;
using Engine = std::function<PosteriorDraws(const Problem& problem)>;

struct EnsembleOptions {
    int walkers = 32;    ///< even, at least twice the parameters
    int settling = 300;  ///< sweeps before the first draw
    int sweeps = 500;    ///< of which each gives a draw per walker
    std::uint64_t seed = 1;
};

/// Walkers that move along lines through each other, whatever the scales of the parameters (Goodman and Weare, Comm. App. Math.
/// Comp. Sci. 5 (2010) 65).
Engine ensemble(const EnsembleOptions& options = {});

}  // namespace coagula::diagnose
