// SPDX-License-Identifier: GPL-3.0-or-later
// Discrepancy of a model: a smooth deviation on top of it (Kennedy and O'Hagan, J. R. Stat. Soc. B 63 (2001) 425).
#pragma once

#include "hypothesis.hpp"
#include "smooth.hpp"

#include <Eigen/Core>

#include <limits>

namespace coagula::diagnose {

struct Discrepancy {
    double log_factor = 0;  ///< on the evidence of the fit, averaged over coordinates, amplitudes and lengths
    Fit fit = {};           ///< most probable beside the best one; intervals are those of a normal posterior
    double best = -std::numeric_limits<double>::infinity();  ///< logarithm of the factor of the best one
    std::vector<Coordinate> along = {};                      ///< those of the best one
    Eigen::MatrixXd factor = {};                             ///< its directions, of unit deviation, of every number
    Eigen::MatrixXd directions = {};                         ///< the same, whitened
    Eigen::VectorXd departure = {};                          ///< most probable one along them, of every number
};

/// At a fit, whose stiffness and parameters follow: linearised there, and again where they are led to. Those at an active end of
/// their prior stay.
Discrepancy find_discrepancy(const Inference& inference, const Fit& fit, const SmoothDepartures& departures);

/// What departures along some directions beside a fit explain.
struct DeparturesAlong {
    double log_factor;          ///< on the evidence of the fit, averaged over directions and amplitudes
    Eigen::VectorXd departure;  ///< most probable one along the best of these, of every number
};
/// @param directions sets of unit amplitude [unit of the numbers].
DeparturesAlong departures_along(const Inference& inference, const Fit& fit, const std::vector<Eigen::MatrixXd>& directions);

/// Factor on the evidence of the fit by a discrepancy along these directions alone, as a logarithm.
double log_factor_along(const Inference& inference, const Fit& fit, const Eigen::MatrixXd& directions);

}  // namespace coagula::diagnose
