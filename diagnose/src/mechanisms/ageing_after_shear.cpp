#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

bool sheared_before(const Experiment& experiment) {
    return experiment.sample.sheared_before ||
           any_measurement(experiment, [](const Measurement& table) { return std::isfinite(table.preshear); });
}

}  // namespace

/// Cement and clay pastes gain orders of magnitude within minutes after mixing (Roussel, Cement and Concrete Research 36 (2006)
/// 1797, has them linear in time), far beyond the logarithm of a gel that is old.
Mechanism ageing_after_shear() {
    return {.name = "ageing-after-shear",
            .term = "the structure that the shear before the run destroyed builds up again: the stiffness grows as a power of time",
            .signature = "follows the time since the shear, not the strain, over orders of magnitude",
            .parameters = {{"build_up_exponent", "1", 0.1, 3, true}, {"build_up_time", "s", 1, 1000, true}},
            .effect = ScalesMaterial{[](const Observation& row, Values values, const SimulatedSample&) -> std::complex<double> {
                return std::isfinite(row.age) ? std::pow(1 + row.age / values[1], values[0]) : 1;
            }},
            .applies = sheared_before};
}

}  // namespace coagula::diagnose::mechanisms
