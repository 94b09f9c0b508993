// SPDX-License-Identifier: GPL-3.0-or-later
// Yield curve of a large sample, from a few simulated structures.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// The yield curve of a sample of very many particles and, after it, that curve moved by each of the independent standard errors
/// that these structures leave. A single structure yields in steps; the mean over very many is smooth, which is what these curves
/// are taken as noisy measurements of: the part of the modulus that is lost per logarithm of the load, and the energy lost over
/// what the broken bonds had stored, are Gaussian processes of the logarithm of the load.
///
/// @param loads growing. @param structures nodes x structures: settled storage modulus over that at rest and, imaginary, what the
/// first oscillation loses.
/// @return nodes x curve and errors, the same numbers; the curve alone, as it is, of a single structure, whose scatter is not
/// known.
Eigen::MatrixXcd population_curve(const std::vector<double>& loads, const Eigen::MatrixXcd& structures);

}  // namespace coagula::diagnose
