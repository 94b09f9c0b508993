// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/recognised_table.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/readable.hpp>
#include <coagula/diagnose/check_data.hpp>
#include <coagula/diagnose/step_test.hpp>
#include <coagula/diagnose/tool_constants.hpp>
#include <coagula/experiment/export_metadata.hpp>

#include "rate_steps.hpp"
#include "table_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace coagula::experiment {

namespace {

using diagnose::Measurement;
using diagnose::MeasurementKind;

constexpr double varies_from = 1.2;      // largest over smallest value; set points that an instrument holds vary less
constexpr double ramp_from = 5;          // K
constexpr double gap_series_from = 1.5;  // a gap that follows the sample varies less
constexpr std::size_t fewest_rows = 5;   // that tell whether a sample gives way, or what it does at a rate

/// The numbers of a column in rows that have a storage modulus, or in all rows where none has.
std::vector<double> readable(const Measurement& table, std::string_view name) {
    const diagnose::Column* column = diagnose::find_column(table, name);
    const diagnose::Column* modulus = diagnose::find_column(table, "storage_modulus");
    const auto finite = [](double value) { return std::isfinite(value); };
    const bool moduli = modulus != nullptr && std::any_of(modulus->values.begin(), modulus->values.end(), finite);
    std::vector<double> values;
    for (std::size_t row = 0; column != nullptr && row < column->values.size(); ++row) {
        if (finite(column->values[row]) && (!moduli || finite(modulus->values[row]))) {
            values.push_back(column->values[row]);
        }
    }
    return values;
}

/// Largest over smallest magnitude; 1 for a column that is missing or zero somewhere.
double spread(const Measurement& table, std::string_view name) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const double value : readable(table, name)) {
        low = std::min(low, std::abs(value));
        high = std::max(high, std::abs(value));
    }
    return low > 0 && high > 0 && std::isfinite(low) ? high / low : 1;
}

std::string range_of(const Measurement& table, std::string_view name) {
    const std::vector<double> values = readable(table, name);
    const std::string unit(diagnose::find_quantity(name)->unit);
    return std::string(name) + " goes from " + with_unit(values.front(), unit) + " to " + with_unit(values.back(), unit);
}

bool has(const Measurement& table, std::string_view name) {
    return !readable(table, name).empty();
}

RecognisedTable with_axis(MeasurementKind kind, const Measurement& table, std::string_view axis) {
    return {kind, range_of(table, axis)};
}

/// What to do about columns that nobody understood.
std::string remedy(const io::PlainTable& table, const std::string& missing) {
    const std::vector<std::string> unknown = not_understood(table, {});
    if (unknown.empty()) {
        return "";
    }
    const std::string heading = unknown.size() == 1 ? unknown[0].substr(1, unknown[0].size() - 2) : "HEADING";
    return "; not understood: " + list_of(unknown) +
           "; if one of them is it, write an experiment file whose [[measurement]] says " + "columns = { " + missing + " = \"" +
           heading + "\" }";
}

/// What cannot be a measurement of moduli.
std::string other_test(const io::PlainTable& table) {
    const auto numbers = [&](const char* quantity) {
        return std::any_of(table.columns.begin(), table.columns.end(), [&](const io::PlainColumn& column) {
            return column.quantity == quantity &&
                   std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
        });
    };
    if (!table.has_headings) {
        return "the file names no columns; write columns = [\"strain [%]\", \"G' [Pa]\", ...], one name per column, and a kind";
    }
    for (const io::PlainColumn& column : table.columns) {
        if (column.quantity == "storage_modulus") {
            return "the column '" + column.heading + "' holds no number";
        }
    }
    const bool oscillates = numbers("angular_frequency") || numbers("frequency");
    const std::string test = oscillates                      ? "an oscillation: "
                             : numbers("relaxation_modulus") ? "a relaxation: "
                             : numbers("shear_rate")         ? "a flow curve or steps of the rate: "
                                                             : "";
    const std::string modulus = oscillates ? "there is neither a storage modulus nor |G*| or |eta*| with a phase or loss tangent"
                                           : "there is no storage modulus";
    return test + modulus + remedy(table, "storage_modulus");
}

/// Whether a column stays to 10 % of its largest value, and a strain to 0.5, since strains of flows add up; a missing one does.
bool stays(const Measurement& table, std::string_view name) {
    const std::vector<double> values = readable(table, name);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return values.empty() ||
           (*high - *low <= 0.1 * std::max(std::abs(*low), std::abs(*high)) && (name != "strain" || *high - *low <= 0.5));
}

/// Whether the stress at a constant rate is still to come: the first row shows less than most of the largest one.
bool starts_up(const Measurement& table) {
    constexpr double most = 0.7;
    const std::vector<double> values = readable(table, has(table, "stress") ? "stress" : "viscosity");
    const auto larger = [](double a, double b) { return std::abs(a) < std::abs(b); };
    return std::abs(values.front()) < most * std::abs(*std::max_element(values.begin(), values.end(), larger));
}

/// A step of stress, strain or rate and what follows it in time, where the table shows no oscillation.
std::optional<RecognisedTable> step_in_time(const Measurement& table) {
    if (!has(table, "time") || has(table, "angular_frequency")) {
        return std::nullopt;
    }
    const auto changes = [&](std::string_view name) { return has(table, name) && !stays(table, name); };
    const auto kept = [&](std::string_view name) { return has(table, name) && stays(table, name); };
    if ((changes("relaxation_modulus") && stays(table, "strain")) || (kept("strain") && changes("stress"))) {
        return with_axis(MeasurementKind::stress_relaxation, table, "time");
    }
    if ((changes("compliance") && stays(table, "stress")) || (kept("stress") && changes("strain") && !kept("shear_rate"))) {
        return with_axis(MeasurementKind::creep, table, "time");
    }
    if (kept("shear_rate") && (has(table, "stress") || has(table, "viscosity"))) {
        return with_axis(starts_up(table) ? MeasurementKind::start_up : MeasurementKind::steady_shear, table, "time");
    }
    return std::nullopt;
}

/// A step or a flow curve.
RecognisedTable without_modulus(const io::PlainTable& plain, const Measurement& table) {
    if (auto step = step_in_time(table)) {
        return std::move(*step);
    }
    // In a creep the rate falls, but the stress stays.
    const bool flows = has(table, "viscosity") || has(table, "stress");
    const bool creeps = has(table, "stress") && spread(table, "stress") < varies_from;
    if (flows && !creeps && spread(table, "shear_rate") > varies_from) {
        return with_axis(MeasurementKind::flow_curve, table, "shear_rate");
    }
    return {std::nullopt, other_test(plain)};
}

RecognisedTable by_columns(const io::PlainTable& plain, const Measurement& table) {
    if (has(table, "x") && has(table, "y") && has(table, "z")) {
        return {MeasurementKind::coordinates, "there are x, y and z"};
    }
    if (has(table, "pore_radius") && has(table, "exclusion_probability")) {
        return with_axis(MeasurementKind::pore_curve, table, "pore_radius");
    }
    if (has(table, "third_harmonic_storage") && has(table, "strain")) {
        return with_axis(MeasurementKind::harmonics, table, "strain");
    }
    if (!has(table, "storage_modulus")) {
        return without_modulus(plain, table);
    }
    for (const char* axis : {"heterogeneity", "coordination", "volume_fraction"}) {
        if (spread(table, axis) > 1) {
            return with_axis(MeasurementKind::structure_series, table, axis);
        }
    }
    const double frequency = spread(table, "angular_frequency");
    const double strain = spread(table, "strain");
    if (frequency > varies_from && frequency >= strain) {
        return with_axis(MeasurementKind::frequency_sweep, table, "angular_frequency");
    }
    if (strain > varies_from) {
        return with_axis(MeasurementKind::amplitude_sweep, table, "strain");
    }
    if (!has(table, "strain") && spread(table, has(table, "deflection") ? "deflection" : "stress") > varies_from) {
        return {std::nullopt, "a sweep of the amplitude without a column of the strain, which is the axis of an amplitude-sweep"};
    }
    if (spread(table, "gap") > gap_series_from) {
        return with_axis(MeasurementKind::gap_series, table, "gap");
    }
    const std::vector<double> temperature = readable(table, "temperature");
    const auto [coldest, warmest] = std::minmax_element(temperature.begin(), temperature.end());
    if (!temperature.empty() && *warmest - *coldest > ramp_from) {
        return {std::nullopt, "a ramp of the temperature, which is the axis of no kind"};
    }
    if (has(table, "time")) {
        return with_axis(MeasurementKind::time_sweep, table, "time");
    }
    return {std::nullopt, "no column varies that is the axis of a kind"};
}

/// Whether the sample gives way: its modulus falls by half or more while the strain grows, or its viscosity while the rate does.
bool yields(const Measurement& table) {
    const bool flows = table.kind == MeasurementKind::flow_curve;
    if (!flows && table.kind != MeasurementKind::amplitude_sweep) {
        return false;
    }
    const char* axis = flows ? "shear_rate" : "strain";
    const char* answer = flows ? "viscosity" : "storage_modulus";
    const diagnose::Column* along = diagnose::find_column(table, axis);
    const diagnose::Column* values = diagnose::find_column(table, answer);
    std::vector<std::pair<double, double>> rows;
    for (std::size_t row = 0; along != nullptr && values != nullptr && row < table.rows(); ++row) {
        if (along->values[row] > 0 && values->values[row] > 0) {
            rows.emplace_back(along->values[row], values->values[row]);
        }
    }
    if (rows.size() < fewest_rows) {
        return false;
    }
    std::sort(rows.begin(), rows.end());
    // The torques of the lowest rates may be at the floor of the instrument.
    const auto [first_rate, first] = rows[flows ? rows.size() / 2 : 0];
    const auto [last_rate, last] = rows.back();
    return flows ? std::log(first / last) > 0.2 * std::log(last_rate / first_rate) : first > 2 * last;
}

/// Units that are assumed where a table names none at all. Strains and phases, which come in two units each, are not among them.
ColumnRules assumed_units(const io::PlainTable& table) {
    constexpr std::array assumed = {"angular_frequency", "frequency", "time",   "storage_modulus",   "loss_modulus",
                                    "complex_modulus",   "viscosity", "stress", "complex_viscosity", "shear_rate"};
    ColumnRules rules;
    for (const io::PlainColumn& column : table.columns) {
        if (!column.unit.empty()) {
            return {};
        }
        if (std::find(assumed.begin(), assumed.end(), column.quantity) != assumed.end()) {
            const std::string unit(diagnose::find_quantity(column.quantity)->unit);
            rules.headings.emplace(column.quantity, column.heading + " [" + unit + "]");
        }
    }
    return rules;
}

/// Why a table of this kind would not pass `diagnose check`; empty where it would.
std::string problem_of(Measurement measurement, const diagnose::Instrument& instrument) {
    try {
        diagnose::derive_viscosity(measurement);
        diagnose::derive_step_response(measurement, instrument, false);
        diagnose::CheckedMeasurement checked = diagnose::check_data(measurement);
        if (!checked.problems.empty()) {
            return checked.problems.front();
        }
        diagnose::Experiment experiment;
        experiment.measurements.push_back(std::move(checked.measurement));
        diagnose::convert_step_tests(experiment);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// A reason without the label of its table, which is told beside it.
std::string unlabelled(std::string reason, const std::string& label) {
    const std::size_t place = reason.find(label + ": ");
    return place == std::string::npos ? reason : reason.erase(place, label.size() + 2);
}

/// The table as one measurement.
RecognisedTable as_one(const io::PlainTable& table, const diagnose::Instrument& instrument) {
    const std::string label = "table " + std::to_string(table.number);
    try {
        const ColumnRules rules = table.has_headings ? assumed_units(table) : ColumnRules{};
        Measurement measurement = to_measurement(table, MeasurementKind::frequency_sweep, label, rules);
        diagnose::derive_moduli(measurement, instrument, false);
        RecognisedTable recognised = by_columns(table, measurement);
        recognised.rules = rules;
        if (recognised.kind) {
            measurement.kind = *recognised.kind;
            diagnose::derive_viscosity(measurement);
            recognised.yields = yields(measurement);
            if (const std::string problem = problem_of(measurement, instrument); !problem.empty()) {
                recognised = {std::nullopt,
                              std::string(diagnose::name_of(*recognised.kind)) + ", but " + unlabelled(problem, label)};
            }
        }
        return recognised;
    } catch (const InputError& error) {
        return {std::nullopt, unlabelled(error.what(), label)};
    }
}

/// Rows of a table that follow a step of the rate.
RecognisedTable as_step(const io::PlainTable& rows, const RateStep& step, const diagnose::Instrument& instrument) {
    RecognisedTable recognised{MeasurementKind::start_up, "shear_rate steps from " + with_unit(step.rate_before, "1/s") + " to " +
                                                              with_unit(step.rate, "1/s")};
    recognised.rules = assumed_units(rows);
    recognised.step = step;
    const std::string label = "table " + std::to_string(rows.number);
    const Measurement measurement = start_up_of(to_measurement(rows, MeasurementKind::start_up, label, recognised.rules), step);
    if (const std::string problem = problem_of(measurement, instrument); !problem.empty()) {
        recognised.kind.reset();
        recognised.reason += ", but " + unlabelled(problem, label);
    }
    return recognised;
}

/// The plateaus of the rate, each as what it is.
std::vector<RecognisedTable> steps_in(const io::PlainTable& table, const diagnose::Instrument& instrument) {
    if (!table.has_headings) {
        return {};
    }
    std::vector<RecognisedTable> parts;
    try {
        const Measurement whole = to_measurement(table, MeasurementKind::start_up, "table", assumed_units(table));
        for (const RatePlateau& plateau : has(whole, "storage_modulus") ? std::vector<RatePlateau>{} : rate_plateaus(whole)) {
            if (!plateau.step && plateau.last + 1 - plateau.first < fewest_rows) {
                continue;  // it shows the rate before the first step
            }
            const io::PlainTable rows = part_of(table, {plateau.first, plateau.last});
            parts.push_back(plateau.step ? as_step(rows, *plateau.step, instrument) : as_one(rows, instrument));
            parts.back().first = plateau.first + 1;
            parts.back().last = plateau.last + 1;
        }
    } catch (const InputError&) {  // as_one has said why
        parts.clear();
    }
    return parts;
}

/// The whole table, or the sweeps or steps in it where it cannot be used as a whole.
std::vector<RecognisedTable> recognise_table(const io::PlainTable& table, const diagnose::Instrument& instrument) {
    RecognisedTable whole = as_one(table, instrument);
    if (whole.kind) {
        return {std::move(whole)};
    }
    const auto is_used = [](const RecognisedTable& part) { return part.kind.has_value(); };
    std::vector<RecognisedTable> parts = steps_in(table, instrument);
    if (std::any_of(parts.begin(), parts.end(), is_used)) {
        return parts;
    }
    if (!parts.empty()) {
        const auto shorter = [](const RecognisedTable& one, const RecognisedTable& other) {
            return one.last - one.first < other.last - other.first;
        };
        whole.reason = std::max_element(parts.begin(), parts.end(), shorter)->reason;
        parts.clear();
    }
    for (const RowRange& rows : sweeps_in(table)) {
        parts.push_back(as_one(part_of(table, rows), instrument));
        parts.back().first = rows.first + 1;
        parts.back().last = rows.second + 1;
    }
    return std::any_of(parts.begin(), parts.end(), is_used) ? parts : std::vector<RecognisedTable>{std::move(whole)};
}

/// What the export says about it.
diagnose::Instrument instrument_of(const io::MeasuredFile& file) {
    ExportMetadata metadata;
    metadata.add(file.path, file, 0, 0);
    diagnose::Experiment experiment;
    metadata.give_to(experiment);
    return experiment.instrument;
}

}  // namespace

std::vector<std::string> understood(const io::PlainTable& table) {
    std::vector<std::string> quantities;
    for (const io::PlainColumn& column : table.columns) {
        const bool numbers =
            std::any_of(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
        if (numbers && !column.quantity.empty() &&
            std::find(quantities.begin(), quantities.end(), column.quantity) == quantities.end()) {
            quantities.push_back(column.quantity);
        }
    }
    return quantities;
}

RecognisedFile recognise(const std::string& path) {
    RecognisedFile recognised{io::read_measured_file(path), {}};
    const diagnose::Instrument instrument = instrument_of(recognised.file);
    for (std::size_t place = 0; place < recognised.file.tables.size(); ++place) {
        if (recognised.file.tables[place].point == 0) {
            for (RecognisedTable& table : recognise_table(recognised.file.tables[place], instrument)) {
                table.place = place;
                recognised.tables.push_back(std::move(table));
            }
        }
    }
    return recognised;
}

std::size_t rows_of(const io::PlainTable& table, const RecognisedTable& what) {
    return what.first == 0 ? table.rows() : what.last - what.first + 1;
}

}  // namespace coagula::experiment
