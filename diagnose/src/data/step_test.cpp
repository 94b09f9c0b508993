// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/step_test.hpp>

#include "median.hpp"
#include "step_columns.hpp"
#include "step_smoothing.hpp"
#include "step_transform.hpp"
#include "table_cells.hpp"

#include <coagula/common/readable.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <optional>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double step_kept = 0.05;  ///< by which a step may be off its median in a row that is used
constexpr double most_off = 0.2;    ///< of the rows
constexpr std::size_t fewest_rows = 8;
constexpr std::size_t fewest_frequencies = 5;
constexpr double latest_start = 0.1;     ///< first time over the last one
constexpr double loaded = 0.9;           ///< of the largest stress, from which on a relaxation has its strain
constexpr double least_overshoot = 0.1;  ///< of a stress over where it ends
constexpr double most_error = 0.1;       ///< of a modulus over the largest one nearby
constexpr double most_correlated = 0.95;

/// Height of the step; unset where the table has no such column.
double height_of(const Measurement& table) {
    const std::vector<double> values = readable_numbers(find_column(table, step_columns_of(table.kind).step));
    return values.empty() ? unset : median(values);
}

bool stays(double value, double height) {
    return std::isnan(height) || std::isnan(value) || std::abs(value - height) <= step_kept * std::abs(height);
}

/// Refuses a table whose step does not stay.
void require_step(const Measurement& table, double height) {
    const char* name = step_columns_of(table.kind).step;
    const std::vector<double> values = readable_numbers(find_column(table, name));
    const auto off = std::count_if(values.begin(), values.end(), [&](double value) { return !stays(value, height); });
    if (static_cast<double>(off) > most_off * static_cast<double>(values.size())) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const std::string unit(find_quantity(name)->unit);
        refuse(table, "'" + std::string(name) + "' must stay in a " + step_columns_of(table.kind).test + ", but goes from " +
                          with_unit(*low, unit) + " to " + with_unit(*high, unit) +
                          ": choose the rows of one step by rows = [first, last]");
    }
}

/// In a relaxation, the first row in which the strain has been reached; in others 0.
std::size_t first_loaded(const Measurement& table, const std::vector<std::size_t>& rows) {
    if (table.kind != MeasurementKind::stress_relaxation) {
        return 0;
    }
    const Column& modulus = *find_column(table, step_columns_of(table.kind).ratio);
    double largest = 0;
    for (const std::size_t row : rows) {
        largest = std::max(largest, modulus.values[row]);
    }
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](std::size_t row) { return modulus.values[row] >= loaded * largest; });
    return static_cast<std::size_t>(found - rows.begin());
}

/// Rows with a time and a response while the step stays; a response that is zero at time zero is that of before the step.
std::vector<std::size_t> usable_rows(const Measurement& table, double height) {
    const StepColumns names = step_columns_of(table.kind);
    const Column& time = *find_column(table, "time");
    const Column& ratio = *find_column(table, names.ratio);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const bool before = time.values[row] <= 0 && ratio.values[row] == 0;
        if (std::isfinite(time.values[row]) && std::isfinite(ratio.values[row]) && !before &&
            stays(cell(table, names.step, row), height)) {
            rows.push_back(row);
        }
    }
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first_loaded(table, rows)));
    return rows;
}

/// Standard errors that the table states for the response over the step, or for the response; empty: none.
std::vector<double> stated_errors(const Measurement& table, double height) {
    const StepColumns names = step_columns_of(table.kind);
    const Column* ratio = find_column(table, names.ratio);
    const Column* response = find_column(table, names.response);
    if (!ratio->standard_errors.empty() || response == nullptr || !std::isfinite(height)) {
        return ratio->standard_errors;
    }
    std::vector<double> errors = response->standard_errors;
    std::for_each(errors.begin(), errors.end(), [height](double& error) { error /= std::abs(height); });
    return errors;
}

/// Powers of time that a response may follow before its first row: a relaxation does not rise, a compliance or a viscosity does, up
/// to the cube of the time where the torque of an inertia is set.
std::pair<double, double> powers_of(MeasurementKind kind) {
    return kind == MeasurementKind::stress_relaxation ? std::pair{-0.9, 0.2} : std::pair{0.0, 3.0};
}

StepResponse response_of(const Measurement& table, const std::vector<std::size_t>& rows, double height) {
    const Column& time = *find_column(table, "time");
    const Column& ratio = *find_column(table, step_columns_of(table.kind).ratio);
    const auto size = static_cast<Index>(rows.size());
    StepResponse response{Eigen::ArrayXd(size), Eigen::VectorXd(size), {}};
    for (Index k = 0; k < size; ++k) {
        response.times[k] = time.values[rows[static_cast<std::size_t>(k)]];
        response.values[k] = ratio.values[rows[static_cast<std::size_t>(k)]];
    }
    std::tie(response.least_power, response.most_power) = powers_of(table.kind);
    const std::vector<double> stated = stated_errors(table, height);
    response.deviations = scatter_of(response.times, response.values);
    for (Index k = 0; k < size && !stated.empty(); ++k) {
        const double error = stated[rows[static_cast<std::size_t>(k)]];
        response.deviations[k] = error > 0 ? error : response.deviations[k];
    }
    return response;
}

void require_early_start(const Measurement& table, const StepResponse& response) {
    const double first = response.times[response.times[0] > 0 ? 0 : 1];
    const double last = response.times[response.times.size() - 1];
    if (first > latest_start * last) {
        refuse(table,
               "its first row is at " + with_unit(first, "s") + " and its last one at " + with_unit(last, "s") +
                   ", but a step test needs rows from a tenth of that time on; where the clock does not begin with the step, state "
                   "time_zero");
    }
}

/// The stress of a linear sample never exceeds the one that it comes to.
void refuse_overshoot(const Measurement& table, const StepResponse& response, double height) {
    if (table.kind != MeasurementKind::start_up) {
        return;
    }
    const Eigen::VectorXd values = Smoother(response.values, response.deviations).smoothed(response.values);
    const Index part = std::max<Index>(3, values.size() / 5);
    const double end = values.tail(part).mean();
    Index place = 0;
    const double largest = values.maxCoeff(&place);
    if (largest > (1 + least_overshoot) * end && largest - end > 5 * response.deviations[place] && place < values.size() - part) {
        const double time = response.times[place];
        refuse(table,
               "the stress overshoots by " + with_unit(100 * (largest / end - 1), "%") + " at " + with_unit(time, "s") +
                   (std::isfinite(height) ? ", a strain of " + with_unit(100 * height * time, "%") : "") +
                   ": the sample is not linear there, and a start-up that is not linear gives no modulus; choose the rows before "
                   "it by rows = [first, last], or a lower rate");
    }
}

/// G* over the transform of the response.
Complex modulus_of(MeasurementKind kind, const TransformedRow& row) {
    switch (kind) {
        case MeasurementKind::creep:
            return 1.0 / row.value;
        case MeasurementKind::stress_relaxation:
            return row.value;
        default:
            return Complex(0, row.angular_frequency) * row.value;
    }
}

/// The longest run of rows whose errors are small beside the moduli nearby, first and end.
std::pair<std::size_t, std::size_t> trusted(MeasurementKind kind, const std::vector<TransformedRow>& rows) {
    std::pair<std::size_t, std::size_t> longest{0, 0};
    std::size_t first = 0;
    for (std::size_t k = 0; k <= rows.size(); ++k) {
        double nearby = 0;
        for (std::size_t other = k < 2 ? 0 : k - 2; other < std::min(k + 3, rows.size()); ++other) {
            nearby = std::max(nearby, std::abs(modulus_of(kind, rows[other])));
        }
        const bool good = k < rows.size() &&
                          std::hypot(rows[k].along, rows[k].across) * std::abs(modulus_of(kind, rows[k])) <= most_error * nearby;
        if (!good) {
            longest = k - first > longest.second - longest.first ? std::pair{first, k} : longest;
            first = k + 1;
        }
    }
    return longest;
}

/// Largest strain of a step test; that of a start-up is none to which a modulus belongs.
double largest_strain(const Measurement& table, double height, const StepResponse& response) {
    switch (table.kind) {
        case MeasurementKind::creep:
            return std::abs(height) * response.values.maxCoeff();
        case MeasurementKind::stress_relaxation:
            return std::abs(height);
        default:
            return std::abs(height) * response.times[response.times.size() - 1];
    }
}

/// Columns of a step test that its frequency sweep keeps: their medians.
void add_constants(const Measurement& table, std::size_t rows, Measurement& sweep) {
    for (const char* name : {"gap", "plate_radius", "temperature", "normal_force"}) {
        const std::vector<double> values = readable_numbers(find_column(table, name));
        if (!values.empty()) {
            sweep.columns.push_back({name, std::string(find_quantity(name)->unit), std::vector<double>(rows, median(values))});
        }
    }
}

/// Error law of all rows: the mean correlation of neighbours, and how much theirs differ, by which a diagnosis lets the rows tell.
ErrorLaw law_of(const std::vector<TransformedRow>& rows) {
    constexpr double least_deviation = 0.2;
    const Eigen::ArrayXd correlations = Eigen::ArrayXd::NullaryExpr(
        static_cast<Index>(rows.size()) - 1, [&](Index k) { return rows[static_cast<std::size_t>(k) + 1].correlation; });
    const double mean = correlations.mean();
    return {.correlation = std::clamp(mean, 0.01, most_correlated),
            .correlation_error = std::hypot(least_deviation, std::sqrt((correlations - mean).square().mean()))};
}

/// Errors of size and phase of the sweep that stands for a table.
TableErrors errors_of(MeasurementKind kind, const std::vector<TransformedRow>& rows) {
    ColumnErrors storage{"storage_modulus", {}, law_of(rows)};
    ColumnErrors loss{"loss_modulus", {}, law_of(rows)};
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        const double size = std::abs(modulus_of(kind, *row));
        storage.deviations.push_back(row->along * size);
        loss.deviations.push_back(row->across * size);
    }
    return {ErrorSource::reduction, true, {std::move(storage), std::move(loss)}};
}

/// The sweep that stands for the table. Its time is shared out so that a row has its own over the lowest frequency's as one over
/// the frequency: that is when the step shows it.
Measurement sweep_of(const Measurement& table, const std::vector<TransformedRow>& rows, double strain, double last_time) {
    Measurement sweep = table;
    sweep.kind = MeasurementKind::frequency_sweep;
    sweep.columns.clear();
    sweep.left_out.clear();
    Column frequency{"angular_frequency", "rad/s", {}};
    Column time{"time", "s", {}};
    Column storage{"storage_modulus", "Pa", {}};
    Column loss{"loss_modulus", "Pa", {}};
    for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
        const Complex modulus = modulus_of(table.kind, *row);
        frequency.values.push_back(row->angular_frequency);
        time.values.push_back(last_time * rows.front().angular_frequency / row->angular_frequency);
        storage.values.push_back(modulus.real());
        loss.values.push_back(modulus.imag());
    }
    sweep.columns = {std::move(frequency), std::move(time), std::move(storage), std::move(loss)};
    if (table.kind != MeasurementKind::start_up && std::isfinite(strain)) {
        sweep.columns.push_back({"strain", "1", std::vector<double>(rows.size(), strain)});
    }
    add_constants(table, rows.size(), sweep);
    return sweep;
}

StepConversion convert(Measurement& table, std::size_t number) {
    const double height = height_of(table);
    require_step(table, height);
    const std::vector<std::size_t> used = usable_rows(table, height);
    if (used.size() < fewest_rows) {
        refuse(table, std::to_string(used.size()) + " rows remain in which the step stays, but a step test needs " +
                          std::to_string(fewest_rows));
    }
    const StepResponse response = response_of(table, used, height);
    require_early_start(table, response);
    refuse_overshoot(table, response, height);
    std::vector<TransformedRow> rows = transform(response, frequencies_within(response.times));
    const auto [first, end] = trusted(table.kind, rows);
    if (end - first < fewest_frequencies) {
        refuse(table,
               "its transform has an error below 10 % at " + std::to_string(end - first) + " of " + std::to_string(rows.size()) +
                   " angular frequencies, but five are needed: it takes more decades of time, more rows in each, or less scatter");
    }
    rows = {rows.begin() + static_cast<std::ptrdiff_t>(first), rows.begin() + static_cast<std::ptrdiff_t>(end)};
    StepConversion found{number,
                         table.kind,
                         used.size(),
                         rows.size(),
                         rows.front().angular_frequency,
                         rows.back().angular_frequency,
                         largest_strain(table, height, response),
                         errors_of(table.kind, rows),
                         response.times[0],
                         response.times[response.times.size() - 1],
                         table.label,
                         table.sample};
    table = sweep_of(table, rows, found.largest_strain, found.last_time);
    if (found.kind == MeasurementKind::creep) {
        table.stress_controlled = table.stress_controlled.value_or(true);  // what the user states holds
    }
    return found;
}

}  // namespace

std::vector<StepConversion> convert_step_tests(Experiment& experiment) {
    std::vector<StepConversion> conversions;
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        if (is_step_test(experiment.measurements[k].kind)) {
            conversions.push_back(convert(experiment.measurements[k], k));
        }
    }
    return conversions;
}

}  // namespace coagula::diagnose
