#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// From water to where it shows at the frequencies of a rheometer: a polymer in the solvent, or neighbours so close that they move
/// through films.
Mechanism solvent_drag() {
    return {
        .name = "solvent-drag",
        .term = "the solvent drags on every particle that does not follow the strain",
        .signature =
            "a loss modulus in proportion to the frequency, then as a weaker power, while the storage modulus rises towards the "
            "affine one; over few frequencies 'contact-dashpot' and 'contact-relaxation' look alike, and another viscosity of "
            "the solvent separates them",
        .parameters = {{"felt_viscosity", "Pa.s", 1e-3, 100, true}},
        .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.felt_viscosity = values[0]; }},
        .applies = knows_frequency,
        .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
