#include "mechanisms.hpp"

#include "../volume_fraction_gradient.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Between plates the layers are in series; what the modulus of a layer is, structures of other volume fractions say.
bool can_settle_between_plates(const Experiment& experiment) {
    const bool plates = experiment.instrument.geometry.value_or(Geometry::plate_plate) == Geometry::plate_plate;
    return plates && knows_gap(experiment) && differ_in_volume_fraction(experiment.structure_volume_fractions);
}

}  // namespace

Mechanism volume_fraction_gradient() {
    return {.name = "volume-fraction-gradient",
            .term =
                "the sample has settled: its volume fraction grows downwards between the plates, and soft and stiff layers are in "
                "series",
            .signature =
                "all moduli lower by one factor, by the square of the gap: most at wide gaps, where slip and an error of the "
                "gap lower them least",
            .parameters = {{"volume_fraction_difference", "1", 0, 0.05, false, &Settings::volume_fraction_difference}},
            .in_contact = false,
            .applies = can_settle_between_plates};
}

}  // namespace coagula::diagnose::mechanisms
