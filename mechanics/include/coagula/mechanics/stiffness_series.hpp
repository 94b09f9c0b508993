// SPDX-License-Identifier: GPL-3.0-or-later
// Shear modulus against the stiffness of the particles, and the stiffness that matches measured moduli.
#pragma once

#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/quasistatic.hpp>
#include <coagula/mechanics/rheometer.hpp>
#include <coagula/mechanics/straight_line.hpp>

#include <Eigen/Core>

namespace coagula::mechanics {

enum class SeriesMethod {
    linear,       ///< solve_linear
    quasistatic,  ///< secant moduli of equilibria at a small strain, periodic cells only
    dem           ///< run_rheometer, G' of the last oscillation, periodic cells only
};

struct StiffnessSeriesOptions {
    Eigen::VectorXd normal_stiffness;  ///< k_n of a particle [N/m], at least two values, rising, > 0
    double stiffness_ratio = 10;       ///< k_n / k_s, the same for all, > 0
    LinearOptions linear = {};         ///< how each modulus is computed; its two stiffnesses are those of the series, and
                                       ///< bond_tangents must be empty
    SeriesMethod method = SeriesMethod::linear;
    double strain = 1e-6;  ///< of the quasi-static method, not 0
    QuasistaticOptions quasistatic = {};
    RheometerOptions rheometer = {};  ///< its contact model is that of the series
};

/// The moduli of one structure (Schenker et al. 2012, fig. 5).
struct StiffnessSeries {
    Eigen::VectorXd normal_stiffness;   ///< k_n [N/m]
    Eigen::VectorXd shear_stiffness;    ///< k_s [N/m]
    Eigen::VectorXd modulus;            ///< mean of the six orientations at each k_n [Pa]
    Eigen::VectorXd modulus_deviation;  ///< standard deviation over the orientations [Pa]
    StraightLine line;                  ///< of the modulus against k_n: slope [1/m], intercept [Pa]
    StraightLine line_through_origin;
    bool carries_shear = false;  ///< the linear modulus exceeds 1e-8 of the affine one; what is less is rounding
    Index contacts = 0;
    Index rattlers = 0;
};

/// Finds the response at every stiffness by itself, with linear springs. For springs whose stiffnesses keep their ratio the
/// displacements are the same at every k_n, so the modulus is proportional to k_n; a departure from the line through the origin is
/// the error of the solution.
///
/// Throws std::invalid_argument for an impossible series, and as solve_linear, small_strain_moduli and run_rheometer do.
StiffnessSeries measure_stiffness_series(const Packing& packing, const ContactNetwork& bonds, const StiffnessSeriesOptions& options,
                                         const Progress& progress = {});

/// The particle stiffness at which the moduli are those measured.
struct StiffnessCalibration {
    Eigen::VectorXd matching;              ///< k_n that matches each structure by itself [N/m]
    double common = unset;                 ///< k_n of least squared differences of the moduli, all structures together [N/m]
    double common_stderr = unset;          ///< from the differences; unset for one structure
    Eigen::VectorXd modulus_at_common;     ///< of each structure [Pa]
    Eigen::VectorXd difference_at_common;  ///< that modulus less the measured one, relative to the measured one
};

/// @param slope modulus over k_n of each structure [1/m], > 0.
/// @param measured modulus of each structure [Pa], > 0.
/// Throws std::invalid_argument for sizes that differ and values out of range.
StiffnessCalibration calibrate_stiffness(const Eigen::VectorXd& slope, const Eigen::VectorXd& measured);

}  // namespace coagula::mechanics
