// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

#include <numbers>

namespace coagula::diagnose::mechanisms {

namespace {

constexpr double start = 1;  ///< age of the sample when the first run begins [s]

}  // namespace

Mechanism ageing() {
    return {.name = "ageing",
            .term = "the contacts grow stiffer with the age of the sample",
            .signature =
                "The moduli grow with the logarithm of the sample's age. They follow the time and the order of the "
                "runs, not the strain.",
            .kind = {Link::history, Axis::time},
            .parameters = {{"per_decade", "1", 0.02, 0.3, true}},
            .effect = ScalesMaterial{[](const Observation& row, Values values, const SimulatedSample&) -> std::complex<double> {
                return std::isfinite(row.age) ? 1 + values[0] * std::log10(1 + row.age / start) : 1;
            }},
            .applies = [](const Knows& knows) { return knows.clock; },
            .in_contact = true,
            .contact =
                [](ContactModel& model, Values values) {
                    model.ageing_rate = values[0] / std::numbers::ln10;
                    model.ageing_time = start;
                }};
}

}  // namespace coagula::diagnose::mechanisms
