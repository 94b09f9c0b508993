// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

bool has_coordinates(const Knows& knows) {
    return any_measurement(knows.experiment, [](const Measurement& table) { return table.kind == MeasurementKind::coordinates; });
}

}  // namespace

Mechanism localisation_error() {
    return {.name = "localisation-error",
            .term =
                "the centres of particles are found with errors, larger along z than in the plane; some particles are "
                "missed, and some centres belong to no particle",
            .signature =
                "Particles seem to overlap, the contact peak of the pair correlation is lower and wider, and the "
                "coordination falls.",
            .kind = {Link::errors, Axis::distance},
            .parameters = {{"sigma_plane", "m", 2e-9, 2e-7, true},
                           {"sigma_axis", "m", 2e-9, 2e-7, true},
                           {"missed_share", "1", 1e-3, 0.1, true},
                           {"false_share", "1", 1e-3, 0.1, true}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) {
                settings.localisation_plane = values[0];
                settings.localisation_axis = values[1];
                settings.missed_share = values[2];
                settings.false_share = values[3];
            }},
            .applies = has_coordinates};
}

}  // namespace coagula::diagnose::mechanisms
