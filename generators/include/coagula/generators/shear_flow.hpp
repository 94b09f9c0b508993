// SPDX-License-Identifier: GPL-3.0-or-later
// Simple shear of a suspension in a periodic box whose images slide past each other (Lees and Edwards, J. Phys. C 5 (1972) 1921).
#pragma once

#include <coagula/common/checks.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace coagula::generators {

/// The liquid flows along x by the rate of strain times z, at a constant rate or by amplitude sin(2 pi frequency t); it is at rest
/// if nothing is set. The third edge of the box leans along x by strain times its height, less whole lengths of the box.
struct ShearFlow {
    double rate = unset;       ///< [1/s]; 0: at rest, but the stress is measured
    double amplitude = unset;  ///< of strain
    double frequency = unset;  ///< [Hz]

    bool given() const { return !std::isnan(rate) || !std::isnan(amplitude); }
    bool oscillates() const { return !std::isnan(amplitude); }
    double strain(double time) const;
    double largest_rate() const;
};

/// Throws std::invalid_argument unless a rate, or an amplitude above 0 with a frequency above 0, or nothing is given.
void check(const ShearFlow& flow);

/// Stress of the particles at the times of the samples: the mean since the sample before (the first is that of the start). Sum of
/// branch x force over the volume, less kB T times the number density on the diagonal; tension > 0 [Pa]. Neither the viscosity
/// of the liquid is in it nor what single particles add to it (Einstein's 5/2 of the volume fraction): there are no hydrodynamics.
struct StressSeries {
    std::vector<double> strain;                ///< at the time of the sample
    std::vector<double> shear_stress;          ///< along x on planes across z [Pa]
    std::vector<double> contact_shear_stress;  ///< the part of the springs that oppose sliding [Pa]
    std::vector<double> normal_stress_x;       ///< [Pa]
    std::vector<double> normal_stress_y;       ///< [Pa]
    std::vector<double> normal_stress_z;       ///< [Pa]
};

/// Sums over the steps since the last sample, of which the next sample takes the mean. Energies are in kB T.
struct StressSum {
    Eigen::Matrix3d pairs = Eigen::Matrix3d::Zero();    ///< branch x force
    Eigen::Matrix3d sliding = Eigen::Matrix3d::Zero();  ///< the part of the springs that oppose sliding
    std::int64_t times = 0;
};

/// Stress over the rate of strain, or the moduli, over the second half of a run.
struct FlowResponse {
    double particle_viscosity = unset;        ///< mean shear stress over the rate [Pa s]; unset where nothing flows
    double particle_viscosity_error = unset;  ///< standard error of blocks
    double shear_stress = unset;              ///< [Pa]
    double shear_stress_error = unset;
    double first_normal_difference = unset;  ///< normal stress x - z [Pa]
    double first_normal_difference_error = unset;
    double storage_modulus = unset;  ///< of an oscillation [Pa]
    double storage_modulus_error = unset;
    double loss_modulus = unset;
    double loss_modulus_error = unset;
    Eigen::Index blocks = 0;  ///< eighths of the second half of the samples, or its whole cycles
};

/// @param time of the samples [s]. Errors are unset where there are fewer than two blocks.
FlowResponse flow_response(const ShearFlow& flow, const std::vector<double>& time, const StressSeries& stress);

}  // namespace coagula::generators
