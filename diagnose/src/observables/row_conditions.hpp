// SPDX-License-Identifier: GPL-3.0-or-later
// Under which conditions the rows of a table were measured.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/run_clock.hpp>

#include <cstddef>
#include <vector>

namespace coagula::diagnose {

/// Conditions of a row of a table; NaN where nobody states them.
struct RowConditions {
    double strain = unset;              ///< amplitude
    double set_strain = unset;          ///< the same where it was set; in a run under a set stress that stress, as a strain
    double largest_strain = unset;      ///< that the sample has seen up to this row
    double angular_frequency = unset;   ///< [rad/s]
    double time = unset;                ///< on the clock of the sample (run_clock.hpp) [s]
    double age = unset;                 ///< time since the last shear that destroyed the structure [s]
    double place = unset;               ///< among all rows of all runs, 0 .. 1, sample by sample in their order
    double third_place = unset;         ///< place of the third row of the sample
    double last_third_place = unset;    ///< ... and of its last but two
    double gap = unset;                 ///< [m]
    double plate_radius = unset;        ///< [m]
    double torque_per_modulus = unset;  ///< torque per deflection over the modulus [m^3]
    double cone_angle = unset;          ///< [rad]; NaN where there is no cone
    double normal_force = unset;        ///< that pushes the plates apart [N]
    bool rough_plates = false;
    bool solvent_trap = false;
    int run = 0;                     ///< number of the run among those on the sample (run_clock.hpp)
    double fluid_viscosity = unset;  ///< viscosity of a Newtonian fluid in place of the sample [Pa.s]
    // Members for a structure series.
    std::size_t structures = 0;  ///< group that stands for the row; 0: all structures
    double heterogeneity = unset;
    double coordination = unset;
    double volume_fraction = unset;
};

/// Whether a table shows a response to shear.
bool shows_shear(const Measurement& table);

/// Conditions of the rows of the tables that show a response to shear.
class ConditionsOfRows {
public:
    explicit ConditionsOfRows(const Experiment& experiment);

    /// Throws InputError when a structure series does not say which structures stand for the row.
    RowConditions of(std::size_t run, std::size_t row) const;

private:
    /// A run holds what the conditions of its rows need besides the cells.
    struct Run {
        RunTime time;
        double third_place = 0;  ///< as in RowConditions
        double last_third_place = 0;
        std::vector<double> places = {};
        std::vector<double> set_strains = {};
        std::vector<double> largest_strains = {};
    };

    double largest_strain_before(std::size_t run) const;
    void follow_rows(std::size_t number, double place, double step);

    const Experiment& experiment_;
    std::vector<Run> runs_;
};

}  // namespace coagula::diagnose
