// SPDX-License-Identifier: GPL-3.0-or-later
// Difference between the stiffening of Hertz contacts in a large sample and in a few structures.
#pragma once

#include "interpolation.hpp"

#include <Eigen/Core>

namespace coagula::diagnose {

/// Nodes of the response of Hertz contacts: strain over the overlap at rest (over r0); the curve dips at 2 and then rises, which
/// nodes half a decade apart would miss by 1 %.
constexpr NodeAxis hertz_axis{0.177827941, 100, 12};

/// Scatter of the logarithm of the secant modulus at the nodes of hertz_axis over that of small strains.
struct HertzScatter {
    Eigen::MatrixXd errors;  ///< nodes x independent standard errors of the mean over the structures
    double degrees;          ///< of freedom from which their common scale is known
};

/// Structures differ in what they bear once the contacts have stiffened, all at large strains alike, so that few of them tell the
/// shape of the errors badly. Hence it is a stated one, that of 40 structures by void expansion, which falls with the root of the
/// number of particles; the structures at hand correct its scale.
///
/// @param particles mean number in a structure.
/// @param logarithms nodes x structures: of their secant moduli over that of small strains.
HertzScatter hertz_scatter(double particles, const Eigen::MatrixXd& logarithms);

}  // namespace coagula::diagnose
