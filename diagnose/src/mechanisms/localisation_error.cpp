#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

bool has_coordinates(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) { return table.kind == MeasurementKind::coordinates; });
}

}  // namespace

Mechanism localisation_error() {
    return {
        .name = "localisation-error",
        .term = "centres are found with errors, more along z than in the plane; some particles are missed, some centres are none",
        .signature = "overlaps appear, the peak of the contacts is lower and wider, and coordination falls",
        .parameters = {{"sigma_plane", "m", 2e-9, 2e-7, true, &Settings::localisation_plane},
                       {"sigma_axis", "m", 2e-9, 2e-7, true, &Settings::localisation_axis},
                       {"missed_share", "1", 1e-3, 0.1, true, &Settings::missed_share},
                       {"false_share", "1", 1e-3, 0.1, true, &Settings::false_share}},
        .in_contact = false,
        .applies = has_coordinates};
}

}  // namespace coagula::diagnose::mechanisms
