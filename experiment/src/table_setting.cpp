// SPDX-License-Identifier: GPL-3.0-or-later
#include "table_setting.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/run_clock.hpp>

#include <cmath>
#include <utility>

namespace coagula::experiment {

namespace {

double duration(TomlKeys& keys, const std::string& key) {
    const double value = keys.quantity(key, "s").value_or(unset);
    if (value < 0) {
        keys.fail(key, "must be >= 0 s");
    }
    if (value > diagnose::longest_session) {
        keys.fail(key, "is " + to_text(value) + " s, but must be at most a year");
    }
    return value;
}

/// Whether the times of a table are those of a clock that all runs on the sample share.
std::optional<bool> shares_clock(TomlKeys& keys) {
    const std::string clock = keys.text("clock").value_or("");
    if (!clock.empty() && clock != "run" && clock != "sample") {
        keys.fail("clock", "'" + clock + "' is neither run nor sample");
    }
    return clock.empty() ? std::nullopt : std::optional(clock == "sample");
}

/// Whether the stress was set and the strain followed.
std::optional<bool> is_under_stress(TomlKeys& keys) {
    const std::string control = keys.text("control").value_or("");
    if (!control.empty() && control != "stress" && control != "strain") {
        keys.fail("control", "'" + control + "' is neither stress nor strain");
    }
    return control.empty() ? std::nullopt : std::optional(control == "stress");
}

}  // namespace

diagnose::Measurement read_setting(TomlKeys& keys, std::size_t number) {
    diagnose::Measurement setting;
    setting.sample = keys.text("sample").value_or("measurement " + std::to_string(number));
    setting.run_order = keys.small_count("run_order", 0);
    setting.start = keys.moment("start").value_or(unset);
    setting.pause = duration(keys, "pause");
    setting.preshear = duration(keys, "preshear");
    setting.shared_clock = shares_clock(keys);
    setting.stress_controlled = is_under_stress(keys);
    setting.instrument = keys.text("instrument").value_or("");
    setting.rough_plates = keys.flag("rough_plates");
    setting.solvent_trap = keys.flag("solvent_trap");
    setting.cone_angle = keys.quantity("cone_angle", "rad").value_or(unset);
    setting.fluid_viscosity = keys.quantity("fluid_viscosity", "Pa.s").value_or(unset);
    const auto rate = keys.quantity("rate_before", "1/s");
    const auto stress = keys.quantity("stress_before", "Pa");
    if (rate.has_value() != stress.has_value()) {
        keys.fail(rate ? "rate_before" : "stress_before", "needs " + std::string(rate ? "stress_before" : "rate_before") +
                                                              ", too: the steady stress at the rate before the step");
    }
    setting.rate_before = rate.value_or(0);
    setting.stress_before = stress.value_or(0);
    setting.oscillations = keys.small_count("oscillations", 1);
    if (std::isfinite(setting.start) && std::isfinite(setting.pause)) {
        keys.fail("pause", "is given beside 'start', which says it already; leave one of them out");
    }
    if (setting.fluid_viscosity <= 0) {
        keys.fail("fluid_viscosity", "must be > 0 Pa.s");
    }
    return setting;
}

diagnose::Measurement in_setting(diagnose::Measurement setting, diagnose::Measurement table) {
    setting.kind = table.kind;
    setting.label = std::move(table.label);
    setting.columns = std::move(table.columns);
    setting.left_out = std::move(table.left_out);
    return setting;
}

void place_in_range(diagnose::Measurement& measurement, const io::PlainTable& chosen, const io::PlainTable& first,
                    bool from_first_row) {
    measurement.run_order += chosen.number - first.number;
    if (std::isnan(measurement.start) && std::isnan(measurement.pause) && !measurement.shared_clock) {
        measurement.start = from_first_row ? chosen.date : unset;
    } else if (&chosen != &first) {
        measurement.start = unset;
    }
}

}  // namespace coagula::experiment
