// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// 1 / (1 + x^2) + 2 i l x / (1 + x^2), x = (strain / softening strain)^exponent: contacts open and close at rates that strain sets
/// (Kraus, J. Appl. Polym. Sci.: Appl. Polym. Symp. 39 (1984) 75). The loss is largest, l, where half of the modulus is gone.
std::complex<double> softened(const Observation& row, Values values, const SimulatedSample& /*sample*/) {
    if (!std::isfinite(row.strain)) {
        return 1;
    }
    const double opened = std::pow(row.strain / values[0], values[1]);
    return std::complex<double>(1, 2 * values[2] * opened) / (1 + opened * opened);
}

}  // namespace

Mechanism reversible_softening() {
    return {.name = "reversible-softening",
            .term = "contacts open under strain and close again at once",
            .signature =
                "Beyond a strain the storage modulus falls and the loss modulus has a maximum. Both are the same on "
                "the way down in strain as on the way up.",
            .kind = {Link::material, Axis::strain},
            .parameters = {{"softening_strain", "1", 1e-5, 10, true},
                           {"softening_exponent", "1", 0.3, 2, false},
                           {"loss_at_half", "1", 0.003, 1, true}},
            .effect = ScalesMaterial{softened},
            .applies = strains_differ};
}

}  // namespace coagula::diagnose::mechanisms
