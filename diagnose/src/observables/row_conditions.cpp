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

/// The largest strain of each run, and of those before it on the sample.
double largest_strain_before(const Experiment& experiment, const std::vector<RunTime>& times, std::size_t run) {
    double largest = unset;
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Measurement& other = experiment.measurements[k];
        const Column* strain = find_column(other, "strain");
        if (strain != nullptr && other.sample == experiment.measurements[run].sample && times[k].order < times[run].order) {
            largest = std::accumulate(strain->values.begin(), strain->values.end(), largest,
                                      [](double a, double b) { return std::fmax(a, b); });
        }
    }
    return largest;
}

std::vector<RunPlace> run_places(const Experiment& experiment, const std::vector<RunTime>& times) {
    const auto& tables = experiment.measurements;
    std::map<std::string, std::vector<std::size_t>> samples;
    double rows = 0;
    for (std::size_t run = 0; run < tables.size(); ++run) {
        samples[tables[run].sample].push_back(run);
        rows += static_cast<double>(tables[run].rows());
    }
    std::vector<RunPlace> places(tables.size());
    double next = 0;
    for (auto& [sample, runs] : samples) {
        std::stable_sort(runs.begin(), runs.end(), [&](std::size_t a, std::size_t b) { return times[a].order < times[b].order; });
        const double first = next;
        for (const std::size_t run : runs) {
            places[run] = {first / rows, next / rows, 1 / rows};
            next += static_cast<double>(tables[run].rows());
        }
    }
    return places;
}

RowsBefore rows_before(const Measurement& table, double largest_strain) {
    RowsBefore before{std::vector<double>(table.rows()), std::vector<double>(table.rows())};
    double count = 0;
    for (const std::size_t row : rows_in_time(table)) {
        largest_strain = std::fmax(largest_strain, cell(table, "strain", row));
        before.count[row] = count++;
        before.largest_strain[row] = largest_strain;
    }
    return before;
}

}  // namespace

Runs runs_of(const Experiment& experiment) {
    const std::vector<RunTime> times = run_times(experiment);
    return {times, run_places(experiment, times)};
}

ConditionsOfRows::ConditionsOfRows(const Experiment& experiment, const Runs& runs, std::size_t run)
    : experiment_(experiment),
      table_(experiment.measurements[run]),
      time_(runs.times[run]),
      place_(runs.places[run]),
      set_strains_(set_strains(table_)),
      before_(rows_before(table_, largest_strain_before(experiment, runs.times, run))) {}

RowConditions ConditionsOfRows::of(std::size_t row) const {
    const Instrument& instrument = experiment_.instrument;
    const bool series = table_.kind == MeasurementKind::structure_series;
    const bool under_cone = std::isfinite(table_.cone_angle);
    const double gap = cell(table_, "gap", row);
    const double radius = cell(table_, "plate_radius", row);
    const double time = (series ? unset : time_in(table_, row)) + (time_.known ? time_.origin : unset);
    return {.strain = cell(table_, "strain", row),
            .set_strain = set_strains_[row],
            .largest_strain = before_.largest_strain[row],
            .angular_frequency = angular_frequency(table_, row),
            .time = time,
            .age = time - time_.sheared,
            .place = place_.first + before_.count[row] * place_.per_row,
            .sample_place = place_.sample,
            .gap = under_cone ? unset : (std::isnan(gap) ? instrument.gap : gap),
            .plate_radius = std::isnan(radius) ? instrument.plate_radius : radius,
            .torque_per_modulus = tool_constants(instrument, gap, radius, table_.cone_angle).torque_per_modulus(),
            .cone_angle = under_cone ? table_.cone_angle : instrument.cone_angle,
            .normal_force = cell(table_, "normal_force", row),
            .rough_plates = table_.rough_plates,
            .solvent_trap = table_.solvent_trap,
            .run = time_.order,
            .fluid_viscosity = table_.fluid_viscosity,
            .structures = series && !experiment_.structure_groups.empty() ? group_of(table_, row) : 0,
            .heterogeneity = cell(table_, "heterogeneity", row),
            .coordination = cell(table_, "coordination", row),
            .volume_fraction = cell(table_, "volume_fraction", row)};
}

}  // namespace coagula::diagnose
