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

/// A table of harmonics with the errors of what it shows.
struct Harmonics {
    static constexpr std::size_t conditions = 3;  ///< columns, which have no errors

    explicit Harmonics(const Measurement& waveform) : table(empty_table(waveform)) {
        for (std::size_t column = conditions; column < table.columns.size(); ++column) {
            errors.columns.push_back({table.columns[column].name});
        }
    }

    void add_row(const Experiment& experiment, const WaveformHarmonics& found, double relative, double phase);

    Measurement table;
    TableErrors errors{.source = ErrorSource::reduction};
};

void Harmonics::add_row(const Experiment& experiment, const WaveformHarmonics& found, double relative, double phase) {
    table.columns[0].values.push_back(found.strain);
    table.columns[1].values.push_back(found.angular_frequency);
    const auto same = same_oscillation(experiment, table, table.rows() - 1);
    table.columns[2].values.push_back(same ? cell(experiment.measurements[same->measurement], "time", same->row) : unset);
    const auto add = [&](std::size_t shown, double value, double error) {
        table.columns[conditions + shown].values.push_back(value);
        errors.columns[shown].deviations.push_back(error);
    };
    const double error = std::hypot(found.error, third_harmonic_error * found.third_harmonic);
    add(0, found.third_harmonic_storage, error);
    add(1, found.third_harmonic_loss, error);
    const double size = std::hypot(found.storage_modulus, found.loss_modulus);
    add(2, same ? unset : found.storage_modulus, std::hypot(relative * found.storage_modulus, found.error * size));
    add(3, same ? unset : found.loss_modulus, std::hypot(relative * found.loss_modulus, std::hypot(phase, found.error) * size));
}

/// Drops columns without values.
void drop_empty_columns(Harmonics& made) {
    std::erase_if(made.table.columns, [](const Column& column) {
        return std::none_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
    });
    std::erase_if(made.errors.columns, [&](const ColumnErrors& one) { return find_column(made.table, one.column) == nullptr; });
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

void reduce_waveforms(Experiment& experiment, ErrorSpec& errors, double relative, double phase) {
    std::vector<Harmonics> reduced;
    for (const Measurement& waveform : experiment.measurements) {
        if (waveform.kind != MeasurementKind::waveform) {
            continue;
        }
        const auto found = harmonics_of(waveform);
        if (!found) {
            throw InputError(waveform.label + ": " + needs_of_harmonics);
        }
        auto made = std::find_if(reduced.begin(), reduced.end(), [&](const Harmonics& one) {
            return same_run(one.table, waveform) && measured_alike(one.table, waveform);
        });
        if (made == reduced.end()) {
            made = reduced.insert(reduced.end(), Harmonics(waveform));
        }
        made->add_row(experiment, *found, relative, phase);
    }
    std::vector<TableErrors> of_others;
    errors.tables.resize(experiment.measurements.size());
    for (std::size_t table = 0; table < errors.tables.size(); ++table) {
        if (experiment.measurements[table].kind != MeasurementKind::waveform) {
            of_others.push_back(std::move(errors.tables[table]));
        }
    }
    errors.tables = std::move(of_others);
    std::erase_if(experiment.measurements, [](const Measurement& table) { return table.kind == MeasurementKind::waveform; });
    for (Harmonics& made : reduced) {
        drop_empty_columns(made);
        experiment.measurements.push_back(std::move(made.table));
        errors.tables.push_back(std::move(made.errors));
    }
}

}  // namespace coagula::diagnose
