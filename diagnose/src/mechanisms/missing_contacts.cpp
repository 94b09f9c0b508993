// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include "responses/thinned_contacts.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Where the level is open and all rows have one structure, nothing shows a factor.
bool shows_level_or_structures(const Knows& knows) {
    const bool series =
        any_measurement(knows.experiment, [](const Measurement& table) { return table.kind == MeasurementKind::structure_series; });
    return knows.moduli && (std::isfinite(known_scale(knows.experiment).value) || series);
}

}  // namespace

/// Particles that touch in the simulation and bear nothing in the sample: not every pair that meets is bonded.
Mechanism missing_contacts() {
    return {
        .name = "missing-contacts",
        .term = "some contacts of the simulated structures are absent in the sample, at random",
        .signature =
            "All moduli are lower by one factor, most where the coordination is low, until the network bears no "
            "load. In a single structure, softer particles or a lower volume fraction look the same; samples of "
            "several coordinations separate them.",
        .kind = {Link::structure, Axis::coordination},
        .parameters = {{"missing_share", "1", 0, 0.3, false}},
        .effect = ScalesMaterial{[](const Observation& row, Values values, const SimulatedSample& sample) -> std::complex<double> {
            return sample.exact ? exact_thinned_response(sample.simulator, sample.settings, values[0], row.structures)
                                : thinned_response(sample.simulator, values[0], row.structures);
        }},
        .applies = shows_level_or_structures};
}

}  // namespace coagula::diagnose::mechanisms
