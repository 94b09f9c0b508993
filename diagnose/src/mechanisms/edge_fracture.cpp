// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double least_strain = 0.05;  // at which a sample may be driven out of its gap
constexpr double least_share = 1e-6;   // of the torque that is left

/// The second normal stress, in proportion to the square of the strain, against surface tension over the gap.
std::complex<double> fractured(std::complex<double> modulus, const Observation& row, Values values) {
    if (!std::isfinite(row.largest_strain) || is_fluid(row)) {
        return modulus;
    }
    const double critical = values[0] * std::sqrt(usual_gap / (std::isfinite(row.gap) ? row.gap : usual_gap));
    const double share = std::pow(std::min(1.0, critical / row.largest_strain), values[1]);
    return modulus * std::max(share, least_share);
}

bool strains_far(const Knows& knows) {
    return any_measurement(knows.experiment, [](const Measurement& table) {
        const Column* strain = find_column(table, "strain");
        return strain != nullptr &&
               std::any_of(strain->values.begin(), strain->values.end(), [](double value) { return value > least_strain; });
    });
}

}  // namespace

/// Tanner and Keentok, Journal of Rheology 27 (1983) 47: a crack at the rim grows where the second normal stress difference exceeds
/// two thirds of surface tension over its width. What it leaves of the torque is a power of the strain: 4 between plates where the
/// crack ends at the radius that is strained so far.
Mechanism edge_fracture() {
    return {.name = "edge-fracture",
            .term = "beyond a critical strain the sample is driven out of the gap and cracks at its rim",
            .signature =
                "Beyond a critical strain the torque falls, and it does not recover on the way down. The critical "
                "strain falls as one over the square root of the gap; that of yielding bonds does not depend on the "
                "gap.",
            .kind = {Link::geometry, Axis::strain},
            .parameters = {{"fracture_strain", "1", 0.05, 20, true}, {"penetration", "1", 0.3, 6, true}},
            .effect = ChangesGeometry{fractured},
            .applies = strains_far};
}

}  // namespace coagula::diagnose::mechanisms
