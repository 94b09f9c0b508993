// SPDX-License-Identifier: GPL-3.0-or-later
#include "strain_history.hpp"

#include <coagula/diagnose/run_clock.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

/// 0 where the table does not say.
double mean_rate(const Measurement& table, std::size_t row) {
    const double steady = cell(table, "shear_rate", row);
    const double oscillating = 2 / std::numbers::pi * cell(table, "strain", row) * angular_frequency(table, row);
    return std::isfinite(steady) ? std::abs(steady) : std::isfinite(oscillating) ? oscillating : 0.0;
}

/// A table that was measured by shearing the sample, one row after the other.
bool shears(const Measurement& table) {
    return table.rows() > 0 && table.kind != MeasurementKind::structure_series && table.kind != MeasurementKind::harmonics &&
           table.kind != MeasurementKind::waveform && table.kind != MeasurementKind::coordinates &&
           table.kind != MeasurementKind::pore_curve && std::isnan(table.fluid_viscosity);
}

void add_run(const Measurement& table, const RunTime& time, bool destroyed, std::vector<ShearedSpan>& spans) {
    const std::vector<std::size_t> rows = rows_in_time(table);
    const double start = time_in(table, rows.front());
    const double step = rows.size() > 1 ? (time_in(table, rows.back()) - start) / static_cast<double>(rows.size() - 1) : 0.0;
    double from = time.origin + std::max(0.0, start - std::max(step, 0.0));
    from = destroyed ? std::max(from, time.sheared) : from;
    for (const std::size_t row : rows) {
        const double to = time.origin + time_in(table, row);
        if (std::isfinite(to) && to >= from) {
            spans.push_back({from, to, mean_rate(table, row), destroyed && row == rows.front()});
            from = to;
        }
    }
}

}  // namespace

StrainHistory::StrainHistory(const Experiment& experiment) {
    const std::vector<Measurement>& tables = experiment.measurements;
    const std::vector<RunTime> times = run_times(experiment);
    for (std::size_t k = 0; k < tables.size(); ++k) {
        names_.push_back(tables[k].sample);
        std::vector<ShearedSpan>& spans = samples_[tables[k].sample];
        if (times[k].known && shears(tables[k])) {
            const bool destroyed = experiment.sample.sheared_before || std::isfinite(tables[k].preshear);
            add_run(tables[k], times[k], destroyed, spans);
        }
    }
    for (auto& [sample, spans] : samples_) {
        std::stable_sort(spans.begin(), spans.end(), [](const auto& one, const auto& other) { return one.from < other.from; });
    }
}

}  // namespace coagula::diagnose
