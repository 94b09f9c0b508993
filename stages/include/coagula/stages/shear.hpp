// SPDX-License-Identifier: GPL-3.0-or-later
// Response of bonded packings to shear.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/orientation.hpp>
#include <coagula/mechanics/power_law.hpp>
#include <coagula/mechanics/quasistatic.hpp>
#include <coagula/mechanics/relaxation.hpp>
#include <coagula/mechanics/rheometer.hpp>
#include <coagula/mechanics/stiffness_series.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/bond_potential.hpp>
#include <coagula/stages/checkpointing.hpp>
#include <coagula/stages/engine.hpp>
#include <coagula/stages/findings.hpp>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

enum class ShearMethod { linear, frequency, quasistatic, dem };

/// A path of equilibria in each orientation: through cycles of strain, or along a ramp of shear or compression.
struct QuasistaticPath {
    mechanics::RestLength rest_length = mechanics::RestLength::as_found;
    std::vector<double> amplitudes = {};  ///< of strain; empty: a ramp
    Index cycles = 1;                     ///< at each amplitude, of which the last is measured
    Index steps_per_cycle = 32;
    double frequency = unset;  ///< [Hz], for ageing only
    double ramp = 1e-6;        ///< strain at its end
    Index ramp_steps = 1;
    bool uniaxial = false;  ///< the ramp compresses along an axis by this share of the height, instead of a shear
};

struct ShearRun {
    ShearMethod method = ShearMethod::linear;
    ContactModel model;
    std::string model_file = {};  ///< from which the model was read; empty: none
    double bond_tolerance = 0.01;
    std::vector<double> frequencies = {};  ///< [Hz]
    std::optional<mechanics::RelaxationScheme> relax = {};
    mechanics::LinearOptions linear = {};
    mechanics::RheometerOptions rheometer = {};
    QuasistaticPath quasistatic = {};
    std::vector<mechanics::ShearOrientation> orientations = {};
    std::optional<Engine> lammps = {};  ///< which moves the particles instead
    std::optional<Engine> petsc = {};   ///< which solves the linear problem instead
    Checkpointing checkpoint = {};
    Results conditions = {};  ///< under which the results are found, as they stand beside them in the file

    /// Where the results go: "/mechanics/linear" and so on.
    std::string group() const;
};

/// Response of the network that is bonded as the options say, and that network.
struct Sheared {
    ContactNetwork bonds;
    Findings findings;
};

/// The structure that is sheared, as far as it says what its bonds are.
struct BondsOfStructure {
    std::string structure;               ///< its name in messages
    std::optional<BondPotential> bonds;  ///< none: the file says nothing
};

Verb shear_verb();
/// Throws InputError for what needs no packing to be seen wrong.
ShearRun shear_run(const Arguments& arguments);
/// The run for one structure: its bonds give the stiffness, where that is asked for, and the tolerance where none is given. Throws
/// InputError where it says nothing about the stiffness that is asked for.
ShearRun shear_run(const Arguments& arguments, const BondsOfStructure& of);
Sheared shear(const ShearRun& run, const Packing& packing, const Progress& progress);

/// A series of stiffnesses, and the stiffness that matches measured moduli.
struct CalibrationRun {
    mechanics::StiffnessSeriesOptions series;
    std::string method;  ///< "linear", "quasistatic" or "dem"
    double bond_tolerance = 0.01;
    std::optional<Eigen::VectorXd> measured;  ///< one modulus for each structure [Pa]
};

/// What is printed about a calibration, and a table of the series.
struct Calibrated {
    Printed printed;
    std::vector<std::vector<std::string>> rows;
};

Verb calibrate_verb();
/// @param structures how many will be given.
CalibrationRun calibration_run(const Arguments& arguments, std::size_t structures);
/// @param names of the structures, one each.
Calibrated calibrate(const CalibrationRun& run, const std::vector<std::string>& names, const std::vector<Packing>& packings,
                     const Progress& progress);

/// What is printed about a fit, and the profile of a0 as a table.
struct FittedPowerLaw {
    Printed printed;
    std::vector<std::vector<std::string>> rows;
};

Verb fit_power_law_verb();
mechanics::PowerLawOptions power_law_options(const Arguments& arguments);
FittedPowerLaw fit_power_law(const mechanics::PowerLawOptions& options, const mechanics::PowerLawData& data,
                             const Progress& progress);

}  // namespace coagula::stages
