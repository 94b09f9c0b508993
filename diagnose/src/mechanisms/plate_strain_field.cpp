#include "mechanisms.hpp"

#include <limits>

namespace coagula::diagnose::mechanisms {

namespace {

/// At one strain the field has no other signature than bonds that break at once; under a cone there is none.
bool varies_strain(const Measurement& table) {
    const Column* strain = find_column(table, "strain");
    if (strain == nullptr || find_column(table, "storage_modulus") == nullptr || std::isfinite(table.cone_angle)) {
        return false;
    }
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const double value : strain->values) {
        low = std::isfinite(value) ? std::min(low, value) : low;
        high = std::isfinite(value) ? std::max(high, value) : high;
    }
    return high > 1.05 * low;
}

bool sweeps_between_plates(const Experiment& experiment) {
    const auto& geometry = experiment.instrument.geometry;
    return any_measurement(experiment, varies_strain) && geometry && *geometry == Geometry::plate_plate;
}

}  // namespace

Mechanism plate_strain_field() {
    return {.name = "plate-strain-field",
            .term = "bonds break at a finite force, first at the rim of the plates, where the strain is largest",
            .signature = "the yield of bonds of finite strength, spread over a wider range of strain",
            .parameters = {{"rim_critical_strain", "1", 3e-6, 3e-2, true, strength_step}},
            .effect = ChangesSimulation{[](Settings& settings, Values values) { settings.rim_critical_strain = values[0]; }},
            .applies = sweeps_between_plates,
            .in_contact = true};
}

}  // namespace coagula::diagnose::mechanisms
