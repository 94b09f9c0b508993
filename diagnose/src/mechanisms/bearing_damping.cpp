#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

/// From what an air bearing has to a worn one; T = (K G* + i b w) theta (Ewoldt, Johnston and Caretta 2015).
Mechanism bearing_damping() {
    return {.name = "bearing-damping",
            .term = "the bearing of the tool brakes it",
            .signature =
                "adds to the loss modulus in proportion to the frequency and leaves the storage modulus, also in an oil; "
                "less under a larger plate",
            .parameters = {{"damping", "N.m.s", 1e-9, 1e-4, true}},
            .effect = ChangesTool{[](std::complex<double> modulus, const Observation& row, Values values) {
                const double frequency = is_steady(row) ? 1 : row.angular_frequency;
                return std::isfinite(frequency) ? modulus + std::complex<double>(0, values[0] * frequency / row.torque_per_modulus)
                                                : modulus;
            }},
            .applies = [](const Experiment& experiment) {
                return knows_tool(experiment) && (knows_frequency(experiment) || flows(experiment));
            }};
}

}  // namespace coagula::diagnose::mechanisms
