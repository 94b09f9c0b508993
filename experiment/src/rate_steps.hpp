// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of the shear rate in a table that holds several rates one below the other.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/experiment/recognised_table.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace coagula::experiment {

/// Rows in which the rate stays, counted from 0, and the step that leads to them; none leads to the first ones of a table.
struct RatePlateau {
    std::size_t first = 0;
    std::size_t last = 0;
    std::optional<RateStep> step;
};

/// The plateaus of a table whose rate stays in most rows and steps between them; nothing of another table. Rows between plateaus,
/// in which the instrument brings the tool to the next rate, belong to none.
/// @param table in SI units, with `time`, `shear_rate` and `stress` or `viscosity`.
std::vector<RatePlateau> rate_plateaus(const diagnose::Measurement& table);

/// The rows of a plateau as a start-up that begins with the step.
diagnose::Measurement start_up_of(diagnose::Measurement rows, const RateStep& step);

}  // namespace coagula::experiment
