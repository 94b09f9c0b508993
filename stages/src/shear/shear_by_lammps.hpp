// SPDX-License-Identifier: GPL-3.0-or-later
// shear --method dem --engine lammps: LAMMPS brings the strained network to rest.
#pragma once

#include <coagula/stages/shear.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::stages {

/// Throws InputError for options and parameters of the contact that LAMMPS has nothing for.
void check_lammps_can_shear(const Arguments& arguments, const ContactModel& model);

/// The shear of one plane. A shear and its transpose are the same strain.
struct LammpsShear {
    mechanics::ShearOrientation plane;
    double modulus = 0;         ///< from the energy at rest [Pa]
    double stress_modulus = 0;  ///< from the stress at rest [Pa]
    double affine_modulus = 0;  ///< from the energy before anything moved [Pa]
    double change = 0;          ///< relative, of the modulus in the last stage of the settling
    std::int64_t steps = 0;     ///< 0: the network has no modulus here, and nothing ran
};

struct LammpsShears {
    std::vector<LammpsShear> planes;
    std::string version;  ///< of LAMMPS
    double strain = 0;

    const LammpsShear& of(const mechanics::ShearOrientation& orientation) const;
};

/// Runs LAMMPS for the planes of the orientations. Throws InputError for a packing that it cannot hold here, std::runtime_error
/// with its last error when it fails, and where the network does not come to rest.
Findings shear_by_lammps(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress);

/// The results, without the keys of the network.
Findings lammps_findings(const ShearRun& run, const ContactNetwork& bonds, const LammpsShears& found);

}  // namespace coagula::stages
