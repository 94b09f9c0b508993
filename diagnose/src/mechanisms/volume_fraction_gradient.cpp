#include "mechanisms.hpp"

#include "simulate/volume_fraction_gradient.hpp"

#include <coagula/diagnose/simulator.hpp>

namespace coagula::diagnose::mechanisms {

namespace {

/// Between plates the layers are in series; what the modulus of a layer is, structures of other volume fractions say.
bool can_settle_between_plates(const Experiment& experiment) {
    const bool plates = experiment.instrument.geometry.value_or(Geometry::plate_plate) == Geometry::plate_plate;
    return plates && knows_gap(experiment) && differ_in_volume_fraction(experiment.structure_volume_fractions);
}

constexpr double usual_gap = 1e-3;  // m

/// What layers in series do to the modulus of a row.
std::complex<double> layers_of_row(const Observation& row, Values values, const SimulatedSample& sample) {
    if (!std::isfinite(row.gap)) {
        return 1;
    }
    const double nominal = sample.experiment.instrument.gap;
    const double difference = values[0] * row.gap / (std::isfinite(nominal) ? nominal : usual_gap);
    double fraction = row.volume_fraction;
    if (std::isnan(fraction)) {
        const double stated = row.structures == 0 ? sample.experiment.sample.volume_fraction : unset;
        fraction = std::isfinite(stated) ? stated : sample.simulator.volume_fraction(row.structures);
    }
    return layers_in_series(sample.simulator.volume_fraction_exponent(sample.settings, sample.exact),
                            settled_difference(fraction, difference) / fraction);
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
            .parameters = {{"volume_fraction_difference", "1", 0, 0.05, false}},
            .effect = ScalesMaterial{layers_of_row},
            .applies = can_settle_between_plates};
}

}  // namespace coagula::diagnose::mechanisms
