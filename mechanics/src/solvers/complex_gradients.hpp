// SPDX-License-Identifier: GPL-3.0-or-later
// Conjugate orthogonal gradients for complex symmetric systems, six loads at once, each with its own coefficients and its own end.
#pragma once

#include "complex_factor.hpp"

#include <functional>

namespace coagula::mechanics {

struct ComplexSolution {
    ComplexLoads motion;
    int iterations = 0;   ///< largest over the columns
    double residual = 0;  ///< |f - K x| over that of the load, recomputed from K and the motion; largest over the columns
};

/// Solves K x = f by the method of van der Vorst and Melissen (1990, IEEE Trans. Magn. 26, 706): conjugate gradients with the
/// product x.y without conjugation. A column ends when its relative residual is below `tolerance` or the method breaks down.
/// @param load_scale norm of each column's load before its forces cancel: residuals are relative to |f|, but at least to least_load
/// of that; what has cancelled down to rounding errors is no load, and its motion is zero.
ComplexSolution conjugate_orthogonal_gradients(const std::function<void(const ComplexLoads&, ComplexLoads&)>& multiply,
                                               const ComplexLoads& f, const Eigen::Array<double, 1, 6>& load_scale,
                                               const std::function<void(const ComplexLoads&, ComplexLoads&)>& precondition,
                                               double tolerance, int most_iterations);

}  // namespace coagula::mechanics
