// SPDX-License-Identifier: GPL-3.0-or-later
// A network without soft modes in which particles move against the strain.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/random.hpp>

#include <vector>

#include "support/lattices.hpp"

namespace coagula::testing {

/// A crystal that has lost two fifths of its bonds: the softest mode has a hundredth of the stiffness of the stiffest, so errors
/// are those of the rate alone. Particles without a bond do not touch.
struct DilutedCrystal {
    Packing packing = make_lattice(face_centred_cubic(), 4, 4, 4);
    ContactNetwork bonds;

    DilutedCrystal() {
        const ContactNetwork whole = find_contacts(packing, 0.01);
        std::vector<Index> kept;
        for (Index bond = 0; bond < whole.size(); ++bond) {
            if (random_uniform(1, RandomPurpose::test, 0, static_cast<std::uint64_t>(bond))[0] < 0.6) {
                kept.push_back(bond);
            }
        }
        packing.radii *= 0.97;
        bonds.particles = whole.particles;
        bonds.ends = whole.ends(Eigen::all, kept);
        bonds.branch = whole.branch(Eigen::all, kept);
    }
};

}  // namespace coagula::testing
