// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include "responses/volume_fraction_gradient.hpp"

#include <coagula/diagnose/simulator.hpp>

namespace coagula::diagnose::mechanisms {

bool can_settle_between_plates(const Knows& knows) {
    const bool plates = knows.experiment.instrument.geometry.value_or(Geometry::plate_plate) == Geometry::plate_plate;
    return plates && knows.gap && differ_in_volume_fraction(knows.experiment.structure_volume_fractions);
}

std::complex<double> settled_layers(const Observation& row, double difference, const SimulatedSample& sample) {
    if (!std::isfinite(row.gap)) {
        return 1;
    }
    const double nominal = sample.experiment.instrument.gap;
    difference *= row.gap / (std::isfinite(nominal) ? nominal : usual_gap);
    double fraction = row.volume_fraction;
    if (std::isnan(fraction)) {
        const double stated = row.structures == 0 ? sample.experiment.sample.volume_fraction : unset;
        fraction = std::isfinite(stated) ? stated : mean_volume_fraction(sample.simulator, row.structures);
    }
    return layers_in_series(volume_fraction_exponent(sample.simulator, sample.settings, sample.exact),
                            settled_difference(fraction, difference) / fraction);
}

Mechanism volume_fraction_gradient() {
    return {.name = "volume-fraction-gradient",
            .term =
                "the sample has settled: its volume fraction grows downwards between the plates, so that soft and "
                "stiff layers are in series",
            .signature =
                "All moduli are lower by a factor that grows with the square of the gap. It is largest at wide gaps, "
                "where slip and an error of the gap matter least.",
            .kind = {Link::structure, Axis::gap},
            .parameters = {{"volume_fraction_difference", "1", 0, 0.05, false}},
            .effect = ScalesMaterial{[](const Observation& row, Values values, const SimulatedSample& sample) {
                return settled_layers(row, values[0], sample);
            }},
            .applies = can_settle_between_plates};
}

}  // namespace coagula::diagnose::mechanisms
