// SPDX-License-Identifier: GPL-3.0-or-later
// A model gives the density of the data, an engine finds the posterior, and neither knows the other.
#pragma once

#include <coagula/diagnose/mechanism.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

namespace coagula::diagnose {

/// A node holds what is known at one place of the prior of the causes' parameters, 0 .. 1 along each axis; the stiffness is
/// integrated out.
struct Node {
    double log_stiffness = 0;  ///< most probable there
    double deviation = 0;      ///< of log_stiffness
    double log_density = 0;    ///< at the best stiffness
    double log_weight = 0;     ///< stiffness integrated out
};

/// It holds what is left of the data at a place, and how the parameters of the causes move that; all else that is fitted is
/// projected out.
struct ProjectedResidual {
    Eigen::VectorXd residual;  ///< whitened
    Eigen::MatrixXd slopes;    ///< its derivatives by the places of the parameters
};

/// A problem has parameters, of which every place 0 .. 1 is equally probable beforehand, and data that tell more of them. The
/// first parameter is the stiffness; the causes have the others.
struct Problem {
    std::vector<MechanismParameter> priors;  ///< the stiffness first
    double log_stiffness;                    ///< about which a search for it begins
    /// Logarithm of the density of the data, and of what else is known of the parameters, at a place of all of them.
    std::function<double(const Eigen::VectorXd& place)> log_density;

    /// A stiffness to search from at a place of the causes' parameters: the one found before or a better one.
    std::function<double(const Eigen::VectorXd& of_causes, double before)> start;
    /// The stiffness integrated out. @param least log weight from which on the node counts.
    std::function<Node(const Eigen::VectorXd& of_causes, double start, double least)> node;
    std::function<ProjectedResidual(const Eigen::VectorXd& of_causes, double log_stiffness)> residual;

    /// Parameters of the causes.
    Eigen::Index axes() const { return static_cast<Eigen::Index>(priors.size()) - 1; }
    /// Values of the parameters at a place.
    Eigen::VectorXd values_at(const Eigen::VectorXd& place) const {
        return Eigen::VectorXd::NullaryExpr(
            place.size(), [&](Eigen::Index axis) { return priors[static_cast<std::size_t>(axis)].at(place[axis]); });
    }
};

/// Equally probable values of the parameters, one draw per column.
using PosteriorDraws = Eigen::MatrixXd;

struct Posterior {
    Eigen::VectorXd place;  ///< of the causes' parameters, the most probable one
    Node node;              ///< there
    double log_evidence;    ///< of the data; NaN from an engine that does not integrate
    PosteriorDraws draws;
    /// Place of a cause's parameter below which a part of the probability lies.
    std::function<double(Eigen::Index axis, double part)> quantile;
    /// The same of the logarithm of the stiffness. @param further standard deviation that the problem does not know of.
    std::function<double(double part, double further)> log_stiffness_quantile;
};
using Engine = std::function<Posterior(const Problem& problem)>;

/// Nodes on a grid that closes in on where the posterior is, along its principal axes where it is a narrow ridge, with the Laplace
/// approximation for the stiffness: the engine that `diagnose` uses.
Engine grid();

struct EnsembleOptions {
    int walkers = 32;    ///< even, at least twice the parameters
    int settling = 300;  ///< sweeps before the first draw
    int sweeps = 500;    ///< of which each gives a draw per walker
    std::uint64_t seed = 1;
};

/// Walkers that move along lines through each other, whatever the scales of the parameters (Goodman and Weare, Comm. App. Math.
/// Comp. Sci. 5 (2010) 65). They give no evidence.
Engine ensemble(const EnsembleOptions& options = {});

}  // namespace coagula::diagnose
