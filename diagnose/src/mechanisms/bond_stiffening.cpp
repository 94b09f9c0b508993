// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// An exponent of 2 is a force with a cubic part, the first term of any law that is the same in both directions. Strands near their
/// full length stiffen faster; networks that spare their stiffest bonds stiffen more slowly.
double stiffened(double strain, Values values) {
    return 1 + std::pow(std::abs(strain) / values[0], values[1]);
}

}  // namespace

/// Gels of taut strands (Gisler, Ball and Weitz, Phys. Rev. Lett. 82 (1999) 1064).
Mechanism bond_stiffening() {
    return {.name = "bond-stiffening",
            .term = "the force of the bonds grows faster than their extension, as that of strands that are pulled taut",
            .signature =
                "Beyond a strain the storage modulus rises with its square or a similar power. It is the same on the way "
                "down in strain as on the way up, whatever the age, and the stress has a third harmonic. "
                "'contact-nonlinearity' rises as the square root of the strain.",
            .kind = {Link::material, Axis::strain},
            .parameters = {{"stiffening_strain", "1", 1e-4, 10, true}, {"stiffening_exponent", "1", 1.5, 3, false}},
            .effect = BendsStress{stiffened},
            .applies = strains_differ};
}

}  // namespace coagula::diagnose::mechanisms
