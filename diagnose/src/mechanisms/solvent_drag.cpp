// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// From water to where it shows at the frequencies of a rheometer: a polymer in the solvent, or neighbours so close that they move
/// through films.
Mechanism solvent_drag() {
    return {.name = "solvent-drag",
            .term = "the solvent exerts a drag on every particle that does not move with the imposed strain",
            .signature =
                "The loss modulus is proportional to the frequency, and at higher frequencies a weaker power of it, "
                "while the storage modulus rises towards its affine value. Over a narrow range of frequencies this "
                "looks like 'contact-dashpot' and 'contact-relaxation'; a solvent of another viscosity separates "
                "them.",
            .kind = {Link::material, Axis::frequency},
            .parameters = {{"felt_viscosity", "Pa.s", 1e-3, 100, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.felt_viscosity = values[0]; }},
            .applies = [](const Knows& knows) { return knows.frequency; },
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
