// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include "data/strain_history.hpp"
#include "responses/thinned_contacts.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// Share of the bonds after some time at one shear rate.
double approached(double share, double rate, double duration, Values values) {
    const double forming = 1 / values[1];
    const double total = forming + values[0] * rate;
    const double end = forming / total;
    return end + (share - end) * std::exp(-total * std::max(duration, 0.0));
}

/// Share of the bonds at a time on the clock of a sample that had rested long before.
double share_of_bonds(const std::vector<ShearedSpan>& history, double until, Values values) {
    double share = 1;
    double clock = 0;
    for (const ShearedSpan& span : history) {
        if (span.from >= until) {
            break;
        }
        share = span.destroyed ? 0.0 : approached(share, 0, span.from - clock, values);
        share = approached(share, span.rate, std::min(span.to, until) - span.from, values);
        clock = span.to;
    }
    return approached(share, 0, until - clock, values);
}

std::complex<double> left_by_shear(const Observation& row, Values values, const SimulatedSample& sample) {
    if (!std::isfinite(row.time) || is<Viscosity>(row)) {
        return 1;
    }
    const double share = share_of_bonds(sample.history.of(row.measurement), row.time, values);
    return thinned_response(sample.simulator, 1 - share, row.structures);
}

bool shears_in_time(const Knows& knows) {
    const auto shears = [](const Measurement& table) { return find_column(table, "strain") != nullptr; };
    return knows.clock && knows.frequency && any_measurement(knows.experiment, shears);
}

}  // namespace

/// d share / dt = (1 - share) / build-up time - breakdown x shear rate x share (Moore, Transactions of the British Ceramic Society
/// 58 (1959) 470; Mewis and Wagner, Advances in Colloid and Interface Science 147 (2009) 214). The modulus is that of the network
/// with this share of its bonds.
Mechanism thixotropy() {
    return {.name = "thixotropy",
            .term = "shear breaks bonds at a rate of its own, and they form again at rest",
            .signature =
                "The moduli fall with the accumulated strain, faster and farther at a higher shear rate, and recover "
                "with the time at rest. A single sweep upwards looks the same under 'bond-strength', which never "
                "recovers, and 'reversible-softening', which recovers at once; a rest and a second sweep separate the "
                "three.",
            .kind = {Link::history, Axis::age},
            .parameters = {{"breakdown_per_strain", "1", 1e-4, 1e5, true}, {"rebuilding_time", "s", 10, 1e5, true}},
            .effect = ScalesMaterial{left_by_shear},
            .applies = shears_in_time};
}

}  // namespace coagula::diagnose::mechanisms
