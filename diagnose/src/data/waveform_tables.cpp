// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of harmonics in the place of waveforms.
#include <coagula/diagnose/waveform.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

bool same_run(const Measurement& one, const Measurement& other) {
    return one.sample == other.sample && one.run_order == other.run_order;
}

/// A table without rows.
Measurement empty_table(const Measurement& waveform) {
    Measurement table = waveform;
    table.kind = MeasurementKind::harmonics;
    table.label = "harmonics, sample '" + waveform.sample + "'";
    table.left_out.clear();
    table.columns = {{"strain", "1", {}},
                     {"angular_frequency", "rad/s", {}},
                     {"time", "s", {}},
                     {"third_harmonic_storage", "1", {}},
                     {"third_harmonic_loss", "1", {}},
                     {"storage_modulus", "Pa", {}},
                     {"loss_modulus", "Pa", {}}};
    return table;
}

void add_row(const Experiment& experiment, const WaveformHarmonics& found, double relative, double phase, Measurement& table) {
    const auto add = [&](std::size_t column, double value, double error) {
        table.columns[column].values.push_back(value);
        if (column > 2) {
            table.columns[column].standard_errors.push_back(error);
        }
    };
    add(0, found.strain, 0);
    add(1, found.angular_frequency, 0);
    const std::size_t row = table.rows() - 1;
    add(2, unset, 0);
    const double error = std::hypot(found.error, third_harmonic_error * found.third_harmonic);
    add(3, found.third_harmonic_storage, error);
    add(4, found.third_harmonic_loss, error);
    const auto same = same_oscillation(experiment, table, row);
    if (same) {
        table.columns[2].values.back() = cell(experiment.measurements[same->measurement], "time", same->row);
    }
    const double size = std::hypot(found.storage_modulus, found.loss_modulus);
    add(5, same ? unset : found.storage_modulus, std::hypot(relative * found.storage_modulus, found.error * size));
    add(6, same ? unset : found.loss_modulus, std::hypot(relative * found.loss_modulus, std::hypot(phase, found.error) * size));
}

void drop_empty_columns(Measurement& table) {
    std::erase_if(table.columns, [](const Column& column) {
        return std::none_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
    });
}

}  // namespace

std::optional<SweepRow> same_oscillation(const Experiment& experiment, const Measurement& harmonics, std::size_t row) {
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        const Measurement& sweep = experiment.measurements[k];
        if (sweep.kind == MeasurementKind::harmonics || sweep.kind == MeasurementKind::waveform || !same_run(sweep, harmonics)) {
            continue;
        }
        for (std::size_t other = 0; other < sweep.rows(); ++other) {
            const double frequency = angular_frequency(sweep, other);  // unknown where the table has none
            if (alike(cell(sweep, "strain", other), cell(harmonics, "strain", row)) &&
                (std::isnan(frequency) || alike(frequency, angular_frequency(harmonics, row))) &&
                std::isfinite(cell(sweep, "storage_modulus", other))) {
                return SweepRow{k, other};
            }
        }
    }
    return std::nullopt;
}

void reduce_waveforms(Experiment& experiment, double relative, double phase) {
    std::vector<Measurement> reduced;
    for (const Measurement& waveform : experiment.measurements) {
        if (waveform.kind != MeasurementKind::waveform) {
            continue;
        }
        const auto found = harmonics_of(waveform);
        if (!found) {
            throw InputError(waveform.label + ": " + needs_of_harmonics);
        }
        auto table = std::find_if(reduced.begin(), reduced.end(),
                                  [&](const auto& one) { return same_run(one, waveform) && measured_alike(one, waveform); });
        if (table == reduced.end()) {
            table = reduced.insert(reduced.end(), empty_table(waveform));
        }
        add_row(experiment, *found, relative, phase, *table);
    }
    std::erase_if(experiment.measurements, [](const Measurement& table) { return table.kind == MeasurementKind::waveform; });
    for (Measurement& table : reduced) {
        drop_empty_columns(table);
        experiment.measurements.push_back(std::move(table));
    }
}

}  // namespace coagula::diagnose
