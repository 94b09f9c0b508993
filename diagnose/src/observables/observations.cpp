// SPDX-License-Identifier: GPL-3.0-or-later
#include "observations.hpp"

#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/stress_control.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "data/table_cells.hpp"
#include "neighbour_shells.hpp"
#include "pore_curves.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr Index fewest_centres = 20;

/// Standard deviation of a third harmonic over the first where the table states none.
constexpr double unstated_error = 5e-3;

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

/// What a table may show of a response to shear; in this order.
struct Shown {
    const char* column;
    bool loss;
    bool third_harmonic;
};
constexpr std::array<Shown, 4> shown{{{"storage_modulus", false, false},
                                      {"loss_modulus", true, false},
                                      {"third_harmonic_storage", false, true},
                                      {"third_harmonic_loss", true, true}}};
constexpr std::array<Shown, 1> shown_of_flow{{{"viscosity", true, false}}};

std::span<const Shown> shown_in(const Measurement& table) {
    return is_flow(table.kind) ? std::span<const Shown>(shown_of_flow) : std::span<const Shown>(shown);
}

/// The errors of torque and phase at a row whose table states them: as near as can be, G' has the one and G'' the other.
void take_polar_errors(const Measurement& table, Observation& one) {
    const Column& storage = *find_column(table, "storage_modulus");
    const Column& loss = *find_column(table, "loss_modulus");
    const double phase = std::atan2(loss.values[one.row], storage.values[one.row]);
    if (!std::isnan(phase)) {
        one.turned = std::remainder(phase, std::numbers::pi / 2);
        const bool liquid = std::lround((phase - one.turned) / (std::numbers::pi / 2)) % 2 != 0;
        one.of_phase = one.loss != liquid;
    }
    const Column& own = one.of_phase ? loss : storage;
    const Column& other = one.of_phase ? storage : loss;
    one.errors = own.errors;
    one.standard_error = own.standard_errors[one.row];
    one.other_error = other.standard_errors[one.row];
}

/// A cell of these columns with all that the row says about it; time since the start of its table.
Observation observation_at(const Experiment& experiment, std::size_t number, std::size_t row, const Shown& what) {
    const Measurement& table = experiment.measurements[number];
    const Column& column = *find_column(table, what.column);
    const bool series = table.kind == MeasurementKind::structure_series;
    const double gap = cell(table, "gap", row);
    const bool flows = is_flow(table.kind);
    const bool under_cone = std::isfinite(table.cone_angle);
    const double radius = cell(table, "plate_radius", row);
    Observation one{
        .measurement = number,
        .row = row,
        .loss = what.loss,
        .value = column.values[row],
        .standard_error =
            column.standard_errors.empty() ? (what.third_harmonic ? unstated_error : unset) : column.standard_errors[row],
        .of_phase = what.loss && !flows,
        .strain = cell(table, "strain", row),
        .set_strain = cell(table, "strain", row),
        .angular_frequency = angular_frequency(table, row),
        .time = series ? unset : time_in(table, row),
        .shear_rate = flows ? cell(table, "shear_rate", row) : unset,
        .gap = under_cone ? unset : (std::isnan(gap) ? experiment.instrument.gap : gap),
        .plate_radius = std::isnan(radius) ? experiment.instrument.plate_radius : radius,
        .torque_per_modulus =
            tool_constants(experiment.instrument, cell(table, "gap", row), radius, table.cone_angle).torque_per_modulus(),
        .cone_angle = under_cone ? table.cone_angle : experiment.instrument.cone_angle,
        .normal_force = cell(table, "normal_force", row),
        .errors = column.errors,
        .third_harmonic = what.third_harmonic,
        .rough_plates = table.rough_plates,
        .solvent_trap = table.solvent_trap,
        .fluid_viscosity = table.fluid_viscosity,
        .structures = series && !experiment.structure_groups.empty() ? group_of(table, row) : 0,
        .heterogeneity = cell(table, "heterogeneity", row),
        .coordination = cell(table, "coordination", row),
        .volume_fraction = cell(table, "volume_fraction", row)};
    if (table.polar_errors && !what.third_harmonic) {
        take_polar_errors(table, one);
    }
    return one;
}

/// The images of a table of centres: one, or those that its column "frame" numbers.
std::vector<Eigen::Matrix3Xd> images_in(const Measurement& table) {
    const bool several = find_column(table, "frame") != nullptr;
    std::map<double, std::vector<Eigen::Vector3d>> centres;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const Eigen::Vector3d centre(cell(table, "x", row), cell(table, "y", row), cell(table, "z", row));
        const double frame = several ? cell(table, "frame", row) : 0;
        if (centre.allFinite() && std::isfinite(frame)) {
            centres[frame].push_back(centre);
        }
    }
    if (several && centres.empty()) {
        throw InputError(table.label + ": column 'frame' has no number in any row with a centre");
    }
    std::vector<Eigen::Matrix3Xd> images;
    for (const auto& [frame, list] : centres) {
        images.emplace_back(Eigen::Map<const Eigen::Matrix3Xd>(list.front().data(), 3, static_cast<Index>(list.size())));
    }
    return images;
}

/// Coordinates in another unit are far from what particles of this diameter could be.
void require_plausible(const Eigen::Matrix3Xd& centres, double diameter, const std::string& label) {
    constexpr double least = 1e-3;
    const Eigen::Array3d box = (centres.rowwise().maxCoeff() - centres.rowwise().minCoeff()).array() + diameter;
    const double filled = static_cast<double>(centres.cols()) * std::numbers::pi / 6 * std::pow(diameter, 3) / box.prod();
    if (!(filled >= least && filled <= 1)) {
        throw InputError(label + ": particles of " + to_text(diameter / 2) + " m radius at these coordinates would fill " +
                         (filled > 1 ? "more than all" : "less than a thousandth") +
                         " of the box around them: check the unit of the coordinates and sample.particle_radius");
    }
}

/// Neighbours in shells, mean over the images, with the errors of one, because they are of the same particles; none where no
/// image has enough particles far enough from the faces.
std::vector<Observation> neighbours_in(const std::vector<Eigen::Matrix3Xd>& images, std::size_t number, double diameter) {
    std::vector<NeighbourShells> shells;
    for (const Eigen::Matrix3Xd& image : images) {
        shells.push_back(shells_of_points(image, diameter));
        if (shells.back().centres < fewest_centres) {
            shells.pop_back();
        }
    }
    if (shells.empty()) {
        return {};
    }
    const auto mean = [&](const auto& value) {
        return std::transform_reduce(shells.begin(), shells.end(), 0.0, std::plus(), value) / static_cast<double>(shells.size());
    };
    const double centres = mean([](const NeighbourShells& one) { return static_cast<double>(one.centres); });
    std::vector<double> variances(shell_count);
    for (std::size_t shell = 0; shell < shell_count; ++shell) {
        variances[shell] = mean([&](const NeighbourShells& one) { return one.variances[shell]; });
    }
    std::vector<Observation> all;
    for (const ShellGroup& group : groups_of_shells(variances)) {
        all.push_back({.measurement = number,
                       .row = static_cast<std::size_t>(group.first),
                       .value = mean([&](const NeighbourShells& one) {
                           return std::accumulate(one.mean.begin() + group.first, one.mean.begin() + group.first + group.count,
                                                  0.0);
                       }),
                       .standard_error = error_of_count(group.variance) / centres,
                       .distance = inner_end(static_cast<std::size_t>(group.first)) + 0.5 * shell_width * group.count,
                       .shells = static_cast<std::size_t>(group.count),
                       .centres = centres,
                       .mutual = mean([](const NeighbourShells& one) { return one.mutual; })});
    }
    return all;
}

/// Compared as it stands.
bool is_share(const Observation& observation) {
    return observation.third_harmonic || observation.difference;
}

/// What a table of centres shows, where the diameter is known.
std::vector<Observation> seen_in_images(const Experiment& experiment, std::size_t number) {
    const Measurement& table = experiment.measurements[number];
    const double diameter = 2 * experiment.sample.particle_radius;
    const std::vector<Eigen::Matrix3Xd> images = images_in(table);
    for (const Eigen::Matrix3Xd& image : images) {
        require_plausible(image, diameter, table.label);
    }
    std::vector<Observation> all = neighbours_in(images, number, diameter);
    if (images.size() >= 2) {
        const RepeatedImages seen = compare_images(images, diameter, table.label);
        if (seen.centres >= fewest_centres) {
            for (Observation& one : planned_images(number, seen.centres)) {
                one.value = seen.values[static_cast<std::size_t>(*one.difference)];
                one.standard_error = error_of(*one.difference, one.value, one.centres);
                all.push_back(one);
            }
        }
    }
    return all;
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

/// Where the rows of a run are among those of all runs, 0 .. 1: one sample after the other, its runs in their order.
struct RunPlace {
    double sample = 0;  ///< of the first row of the sample
    double first = 0;   ///< of the first row of the run
    double per_row = 0;
};

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

/// What came before each row of a table in the order of time.
struct RowsBefore {
    std::vector<double> count;           ///< of rows of the table
    std::vector<double> largest_strain;  ///< that of the row included
};

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

/// When and where the runs of an experiment were made.
struct Runs {
    std::vector<RunTime> times;
    std::vector<RunPlace> places;
};

/// Whether the table states gap or plates in other rows and not in this one: those of the instrument would be wrong here.
bool lacks_geometry(const Measurement& table, std::size_t row) {
    const auto is_lost = [&](const char* name) {
        const Column* column = find_column(table, name);
        return column != nullptr && !std::isfinite(column->values[row]) &&
               std::any_of(column->values.begin(), column->values.end(), [](double value) { return std::isfinite(value); });
    };
    return is_lost("gap") || is_lost("plate_radius");
}

/// What a table shows of a response to shear.
void add_sheared(std::vector<Observation>& all, const Experiment& experiment, const Runs& runs, std::size_t run) {
    const Measurement& table = experiment.measurements[run];
    const RunTime& time = runs.times[run];
    const RunPlace& place = runs.places[run];
    const bool flows = is_flow(table.kind);
    const std::vector<double> set = set_strains(table);
    const RowsBefore before = rows_before(table, largest_strain_before(experiment, runs.times, run));
    for (const Shown& what : shown_in(table)) {
        const Column* column = find_column(table, what.column);
        // A fluid stores nothing, loses in proportion to the frequency, and has no harmonics.
        const bool fluid = std::isfinite(table.fluid_viscosity);
        const bool takes_part = column != nullptr && (!fluid || (what.loss && !what.third_harmonic));
        for (std::size_t row = 0; takes_part && row < table.rows(); ++row) {
            if (!std::isfinite(column->values[row]) || (fluid && !flows && std::isnan(angular_frequency(table, row))) ||
                (flows && std::isnan(cell(table, "shear_rate", row))) || lacks_geometry(table, row)) {
                continue;
            }
            all.push_back(observation_at(experiment, run, row, what));
            Observation& one = all.back();
            one.run = time.order;
            one.time += time.known ? time.origin : unset;
            one.age = one.time - time.sheared;
            one.sample_place = place.sample;
            one.place = place.first + before.count[row] * place.per_row;
            one.largest_strain = before.largest_strain[row];
            one.set_strain = set[row];
        }
    }
}

}  // namespace

const char* observable_of(const Observation& observation) {
    if (std::isfinite(observation.distance)) {
        return is_along_axis(observation.row) ? "neighbours_axis" : "neighbours_plane";
    }
    if (is_pore(observation)) {
        return "exclusion_probability";
    }
    if (observation.difference) {
        constexpr std::array names{"localisation_plane", "localisation_axis", "unmatched_share"};
        return names.at(static_cast<std::size_t>(*observation.difference));
    }
    if (is_steady(observation)) {
        return shown_of_flow.front().column;
    }
    return shown.at((observation.third_harmonic ? 2 : 0) + (observation.loss ? 1 : 0)).column;
}

bool is_modulus(const Observation& observation) {
    return !std::isfinite(observation.distance) && !is_pore(observation) && !observation.difference && !observation.third_harmonic;
}

double relative_to(const Observation& observation, double level) {
    if (is_modulus(observation)) {
        return level;
    }
    return std::isfinite(observation.distance) ? std::max(level, 1.0) : 1.0;
}

std::vector<Observation> planned_images(std::size_t measurement, double centres) {
    std::vector<Observation> all;
    for (const ImageDifference difference : {ImageDifference::plane, ImageDifference::axis, ImageDifference::unmatched}) {
        all.push_back({.measurement = measurement, .row = shell_count + all.size(), .difference = difference, .centres = centres});
    }
    return all;
}

std::vector<Observation> observations_of(const Experiment& experiment) {
    Runs runs{run_times(experiment), {}};
    runs.places = run_places(experiment, runs.times);
    std::vector<Observation> all;
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        if (table.kind == MeasurementKind::coordinates && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> seen = seen_in_images(experiment, k);
            all.insert(all.end(), seen.begin(), seen.end());
        }
        if (table.kind == MeasurementKind::pore_curve && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> pores = pores_in(experiment, k);
            all.insert(all.end(), pores.begin(), pores.end());
        }
        if (has_moduli(table.kind) || is_flow(table.kind) || table.kind == MeasurementKind::harmonics) {
            add_sheared(all, experiment, runs, k);
        }
    }
    return all;
}

Eigen::ArrayXd complex_moduli(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli) {
    std::map<std::pair<std::size_t, std::size_t>, double> squares;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double value = is_share(observations[k]) ? 0.0 : moduli[static_cast<Index>(k)];
        squares[{observations[k].measurement, observations[k].row}] += value * value;
    }
    Eigen::ArrayXd sizes(moduli.size());
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double square = squares[{observations[k].measurement, observations[k].row}];
        sizes[static_cast<Index>(k)] = is_share(observations[k]) ? 1.0 : std::sqrt(square);
    }
    return sizes;
}

}  // namespace coagula::diagnose
