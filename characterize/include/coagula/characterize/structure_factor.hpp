// SPDX-License-Identifier: GPL-3.0-or-later
// Structure factor S(q) of the centres, two ways: directly from wave vectors, and by the transform of the pair correlation.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct StructureFactorOptions {
    double largest = 25;               ///< largest wave number in units of 1 / (mean diameter)
    Index vectors = 200;               ///< wave vectors of a shell that are used, at most; large packings use fewer, see below
    double extrapolation_range = 3.0;  ///< S(0) is extrapolated from wave numbers up to this, in units of 1 / (mean diameter)
};

/// S(q) = |sum_j exp(i q x_j)|^2 / N, averaged over shells of wave vectors one spacing 2 pi / V^(1/3) wide. All centres count
/// alike, whatever their radius.
///
/// A periodic packing is summed over wave vectors of its box. An open one is seen through the smooth window sin(pi r / R) / r of
/// the largest known ball (radius R) in the hull of its centres, and what the window itself scatters is subtracted (the tapered
/// estimator of Hawat et al., Stat. Comput. 33 (2023) 61); its resolution is pi / R. The sum over particles and vectors is kept
/// below 2e8 terms, down to 10 vectors in a shell.
struct StructureFactor {
    Eigen::VectorXd wave_number;    ///< mean of the vectors of each shell [1/m], ascending
    Eigen::VectorXd direct;         ///< S
    Eigen::VectorXd direct_stderr;  ///< from the spread of the vectors of the shell; S / sqrt(vectors) where they are few
    Eigen::VectorXd
        transformed;  ///< 1 + n int (g - 1) w sin(qr) / (qr) dr^3 up to the largest distance R, w = (1 + cos(pi r / R)) / 2
    Eigen::VectorXd transformed_error;  ///< counting error of a shell as wide as the window makes it, and the bias of the window,
                                        ///< which is pi^2 / (4 R^2) |S'' + 2 S' / q|, added in quadrature
    Eigen::VectorXi vectors;            ///< used in each shell (q and -q count once)
    double at_zero = unset;  ///< S(0) = n k T compressibility in equilibrium; from S = S(0) + b q^2 + c q^4; shells that it does
                             ///< not fit are left out from above, without the
    double at_zero_stderr = unset;           ///< of the least squares; NaN if fewer than four shells are in range
    double peak = unset;                     ///< largest S of the direct sum
    double peak_stderr = unset;              ///< of the shell
    double peak_wave_number = unset;         ///< where [1/m]
    double peak_wave_number_stderr = unset;  ///< half the range of the shells as large within two standard errors; NaN: one shell
};

StructureFactor measure_structure_factor(const Packing& packing, const StructureFactorOptions& options = {});

}  // namespace coagula::characterize
