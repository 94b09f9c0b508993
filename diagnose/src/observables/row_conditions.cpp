// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_conditions.hpp"

#include <coagula/diagnose/stress_control.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "data/table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace coagula::diagnose {

namespace {

/// The group of structures that stands for a row of a structure series: its number, else its place in the table.
std::size_t group_of(const Measurement& table, std::size_t row) {
    const Column* column = find_column(table, "structure");
    if (column == nullptr) {
        return row + 1;
    }
    const double number = column->values[row];
    if (!(number == std::floor(number))) {  // nor where the cell was left out
        throw InputError(table.label + ": column 'structure' must have a whole number in row " + std::to_string(row + 1) +
                         ", one of structures.groups");
    }
    return static_cast<std::size_t>(number);
}

}  // namespace

bool shows_shear(const Measurement& table) {
    return has_moduli(table.kind) || is_flow(table.kind) || table.kind == MeasurementKind::harmonics;
}

ConditionsOfRows::ConditionsOfRows(const Experiment& experiment) : experiment_(experiment) {
    const std::vector<Measurement>& tables = experiment.measurements;
    const std::vector<RunTime> times = run_times(experiment);
    double rows = 0;
    std::map<std::string, std::vector<std::size_t>> samples;
    for (std::size_t run = 0; run < tables.size(); ++run) {
        runs_.push_back({.time = times[run]});
        samples[tables[run].sample].push_back(run);
        rows += static_cast<double>(tables[run].rows());
    }
    double next = 0;  // row, one sample after the other, its runs in their order
    for (auto& [sample, runs] : samples) {
        std::stable_sort(runs.begin(), runs.end(), [&](std::size_t a, std::size_t b) { return times[a].order < times[b].order; });
        double end = next;
        for (const std::size_t run : runs) {
            end += static_cast<double>(tables[run].rows());
        }
        const double first = next;
        for (const std::size_t run : runs) {
            runs_[run].third_place = (first + 2) / rows;
            runs_[run].last_third_place = (end - 3) / rows;
            if (shows_shear(tables[run])) {
                follow_rows(run, next / rows, 1 / rows);
            }
            next += static_cast<double>(tables[run].rows());
        }
    }
}

/// The largest strain of the runs before this one on the sample.
double ConditionsOfRows::largest_strain_before(std::size_t run) const {
    double largest = unset;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        const Measurement& other = experiment_.measurements[k];
        const Column* strain = find_column(other, "strain");
        if (strain != nullptr && other.sample == experiment_.measurements[run].sample &&
            runs_[k].time.order < runs_[run].time.order) {
            largest = std::accumulate(strain->values.begin(), strain->values.end(), largest,
                                      [](double a, double b) { return std::fmax(a, b); });
        }
    }
    return largest;
}

/// Goes through the rows of a run in the order of time.
/// @param place of its first row. @param step of the place from row to row.
void ConditionsOfRows::follow_rows(std::size_t number, double place, double step) {
    const Measurement& table = experiment_.measurements[number];
    Run& run = runs_[number];
    run.set_strains = set_strains(table);
    run.places.resize(table.rows());
    run.largest_strains.resize(table.rows());
    double largest = largest_strain_before(number);
    double count = 0;
    for (const std::size_t row : rows_in_time(table)) {
        largest = std::fmax(largest, cell(table, "strain", row));
        run.places[row] = place + count++ * step;
        run.largest_strains[row] = largest;
    }
}

RowConditions ConditionsOfRows::of(std::size_t number, std::size_t row) const {
    const Measurement& table = experiment_.measurements[number];
    const Run& run = runs_[number];
    const Instrument& instrument = experiment_.instrument;
    const bool series = table.kind == MeasurementKind::structure_series;
    const bool under_cone = std::isfinite(table.cone_angle);
    const double gap = cell(table, "gap", row);
    const double radius = cell(table, "plate_radius", row);
    const double time = (series ? unset : time_in(table, row)) + (run.time.known ? run.time.origin : unset);
    return {.strain = cell(table, "strain", row),
            .set_strain = run.set_strains[row],
            .largest_strain = run.largest_strains[row],
            .angular_frequency = angular_frequency(table, row),
            .time = time,
            .age = time - run.time.sheared,
            .place = run.places[row],
            .third_place = run.third_place,
            .last_third_place = run.last_third_place,
            .gap = under_cone ? unset : (std::isnan(gap) ? instrument.gap : gap),
            .plate_radius = std::isnan(radius) ? instrument.plate_radius : radius,
            .torque_per_modulus = tool_constants(instrument, gap, radius, table.cone_angle).torque_per_modulus(),
            .cone_angle = under_cone ? table.cone_angle : instrument.cone_angle,
            .normal_force = cell(table, "normal_force", row),
            .rough_plates = table.rough_plates,
            .solvent_trap = table.solvent_trap,
            .run = run.time.order,
            .fluid_viscosity = table.fluid_viscosity,
            .structures = series && !experiment_.structure_groups.empty() ? group_of(table, row) : 0,
            .heterogeneity = cell(table, "heterogeneity", row),
            .coordination = cell(table, "coordination", row),
            .volume_fraction = cell(table, "volume_fraction", row)};
}

}  // namespace coagula::diagnose
