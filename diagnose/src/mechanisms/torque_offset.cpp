#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// A smooth viscosity may grow towards low rates in the same way.
bool flows_as_an_oil(const Experiment& experiment) {
    return experiment.material.kind == MaterialKind::newtonian && flows(experiment);
}

}  // namespace

/// Up to a micronewton metre under plates of 25 mm: friction of the bearing, a rim that the sample wets unevenly (Johnston and
/// Ewoldt 2013). It does not oscillate, and so drops out of moduli.
Mechanism torque_offset() {
    return {.name = "torque-offset",
            .term = "a torque that does not come from the sample stays however slowly the tool turns",
            .signature = "the viscosity rises, or falls through zero, towards low shear rates, as one over the rate",
            .parameters = {{"stress_offset", "Pa", -0.1, 0.1, false}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                return is_steady(row) ? modulus + std::complex<double>(0, values[0] / row.shear_rate) : modulus;
            }},
            .applies = flows_as_an_oil};
}

}  // namespace coagula::diagnose::mechanisms
