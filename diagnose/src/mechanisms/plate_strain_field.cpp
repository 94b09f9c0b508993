// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// At one strain the field has no other signature than bonds that break at once; under a cone there is none.
bool varies_strain(const Measurement& table) {
    return varies(table, "strain") && find_column(table, "storage_modulus") != nullptr && std::isnan(table.cone_angle);
}

bool sweeps_between_plates(const Knows& knows) {
    const auto& geometry = knows.experiment.instrument.geometry;
    return any_measurement(knows.experiment, varies_strain) && geometry && *geometry == Geometry::plate_plate;
}

}  // namespace

Mechanism plate_strain_field() {
    return {.name = "plate-strain-field",
            .term =
                "bonds break at a finite force, and they do so first at the rim of the plates, where the strain is "
                "largest",
            .signature = "The bonds yield, as under 'bond-strength', but over a wider range of strain.",
            .kind = {Link::geometry, Axis::strain},
            .parameters = {{"rim_critical_strain", "1", 3e-6, 3e-2, true, strength_step}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.rim_critical_strain = values[0]; }},
            .applies = sweeps_between_plates,
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
