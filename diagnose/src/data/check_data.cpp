// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/check_data.hpp>
#include <coagula/diagnose/waveform.hpp>

#include "longest_ascent.hpp"
#include "median.hpp"
#include "relations.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace coagula::diagnose {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A factor to three digits.
std::string factor_text(double factor) {
    std::ostringstream text;
    text << std::setprecision(3) << factor;
    return text.str();
}

std::string part_of(std::size_t some, std::size_t all) {
    return std::to_string(some) + " of " + std::to_string(all);
}

/// Leaves cells out and collects problems.
class Checker {
public:
    Checker(const Measurement& measurement, const DataCheckOptions& options)
        : options_(options), rule_(rule_of(measurement.kind)), checked_{measurement, {}, {}} {
        if (has_moduli(measurement.kind) && is_liquid()) {
            rule_.required = {"loss_modulus"};  // a Newtonian fluid stores nothing
        }
    }

    CheckedMeasurement run() {
        check_columns();
        if (checked_.problems.empty()) {
            check_whole_numbers();
            check_level();
            leave_out_impossible_cells();
            check_order();
            check_relations();
            check_what_is_left();
        }
        return std::move(checked_);
    }

private:
    Measurement& table() { return checked_.measurement; }
    bool is_liquid() const { return options_.liquid || std::isfinite(checked_.measurement.fluid_viscosity); }
    void complain(const std::string& sentence) { checked_.problems.push_back(table().label + ": " + sentence); }

    Column& column(std::string_view name) {
        return *std::find_if(table().columns.begin(), table().columns.end(), [&](const Column& one) { return one.name == name; });
    }

    void leave_out(Column& from, std::size_t row, const std::string& reason) {
        table().left_out.push_back({from.name, row, to_text(from.values[row]), reason});
        from.values[row] = nothing;
    }

    /// Axis first.
    std::vector<std::string> required_columns() {
        std::vector<std::string> names;
        if (const Column* axis = axis_of(table())) {
            names.push_back(axis->name);
        }
        names.insert(names.end(), rule_.required.begin(), rule_.required.end());
        return names;
    }

    void check_columns();
    void check_whole_numbers();
    void leave_out_impossible_cells();
    void check_level();
    void check_order();
    void check_relations();
    void check_what_is_left();
    std::set<const Column*> evenly_stepped_columns();
    void leave_out_suspects(const std::vector<Relation>& relations);
    bool all_rows_disagree(const Relation& relation, const RelationResult& result);
    void refuse_wrong_assignment();

    DataCheckOptions options_;
    TableRule rule_;
    CheckedMeasurement checked_;
    std::vector<std::string> contradicting_;  ///< columns that were taken out as a whole
};

std::size_t readable(const Column& column) {
    return static_cast<std::size_t>(
        std::count_if(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); }));
}

void Checker::check_columns() {
    const std::string kind(name_of(table().kind));
    if (!rule_.axes.empty() && axis_of(table()) == nullptr) {
        std::string names;
        for (const std::string_view name : rule_.axes) {
            names += (names.empty() ? "'" : " or '") + std::string(name) + "'";
        }
        complain("there is no column " + names + ", which a table of kind " + kind + " needs as its axis");
    }
    for (const std::string_view name : rule_.required) {
        if (find_column(table(), name) == nullptr) {
            complain("there is no column '" + std::string(name) + "', which a table of kind " + kind + " needs");
        }
    }
    const bool has_frequency = find_column(table(), "angular_frequency") != nullptr || find_column(table(), "frequency") != nullptr;
    if (has_moduli(table().kind) && is_liquid() && !has_frequency) {
        complain("a Newtonian fluid needs 'angular_frequency' or 'frequency', with which its loss modulus grows");
    }
    for (const Column& column : table().columns) {
        const Quantity* quantity = find_quantity(column.name);
        if (quantity == nullptr) {
            throw std::invalid_argument(table().label + ": '" + column.name + "' is not a quantity");
        }
        require(quantity->unit == column.unit, table().label + ": column '" + column.name + "' is in " + column.unit +
                                                   ", but must be in " + std::string(quantity->unit));
    }
    for (const std::string& name : required_columns()) {
        if (const Column* needed = find_column(table(), name); needed != nullptr && readable(*needed) == 0) {
            complain("column '" + name + "' has no readable number");
        }
    }
}

/// Columns that count something.
void Checker::check_whole_numbers() {
    for (const char* name : {"frame", "structure"}) {
        const Column* column = find_column(table(), name);
        for (std::size_t row = 0; column != nullptr && row < table().rows(); ++row) {
            const double value = column->values[row];
            if (std::isfinite(value) && value != std::floor(value)) {
                complain("column '" + column->name + "' is " + to_text(value) + " in row " + std::to_string(row + 1) +
                         ", but must hold whole numbers");
                return;
            }
        }
    }
}

void Checker::leave_out_impossible_cells() {
    for (Column& column : table().columns) {
        const Quantity& quantity = *find_quantity(column.name);
        const bool amplitude = column.name == "strain" && table().kind != MeasurementKind::waveform && !is_step_test(table().kind);
        const double low = amplitude ? 0 : quantity.low;
        const bool low_excluded = amplitude || quantity.low_excluded;
        for (std::size_t row = 0; row < table().rows(); ++row) {
            const double value = column.values[row];
            if (value < low || (low_excluded && value == low)) {
                leave_out(column, row, "must be " + std::string(low_excluded ? "> " : ">= ") + to_text(low));
            } else if (value > quantity.high) {
                leave_out(column, row, "must be <= " + to_text(quantity.high));
            }
        }
    }
}

/// A wrong unit.
void Checker::check_level() {
    constexpr double softest = 1e-9;
    constexpr double stiffest = 1e15;
    const Column* storage = find_column(table(), "storage_modulus");
    if (storage == nullptr || is_liquid()) {
        return;
    }
    std::vector<double> values;
    std::copy_if(storage->values.begin(), storage->values.end(), std::back_inserter(values),
                 [](double value) { return std::isfinite(value); });
    // Raw moduli of a heavy tool fall below zero.
    std::for_each(values.begin(), values.end(), [](double& value) { value = std::abs(value); });
    const double middle = median(values);
    if (!values.empty() && !(middle >= softest && middle <= stiffest)) {
        complain("column 'storage_modulus' has a median size of " + to_text(middle) + " Pa; from 1e-9 to 1e15 Pa is possible");
    }
}

void Checker::check_order() {
    if (!rule_.ordered) {
        return;
    }
    Column& axis = column(axis_of(table())->name);
    const std::size_t count = readable(axis);
    std::vector<std::size_t> kept = longest_ascent(axis.values);
    if (axis.name != "time") {
        std::vector<double> mirrored = axis.values;
        std::for_each(mirrored.begin(), mirrored.end(), [](double& value) { value = -value; });
        const std::vector<std::size_t> descent = longest_ascent(mirrored);
        kept = descent.size() > kept.size() ? descent : kept;
    }
    const std::size_t breaking = count - kept.size();
    if (static_cast<double>(breaking) > options_.most_out_of_order * static_cast<double>(count)) {
        complain("the rows are in the wrong order: " + part_of(breaking, count) + " values of '" + axis.name +
                 "' break its direction; sort them, or give each sweep as a table of its own");
        return;
    }
    const std::set<std::size_t> in_order(kept.begin(), kept.end());
    for (std::size_t row = 0; row < table().rows(); ++row) {
        if (std::isfinite(axis.values[row]) && !in_order.contains(row)) {
            leave_out(axis, row, "breaks the direction of the axis");
        }
    }
}

/// Columns that are set, not measured, and whose steps are even throughout (constant, arithmetic or geometric): every cell lies
/// where its neighbours say.
std::set<const Column*> Checker::evenly_stepped_columns() {
    constexpr double slack = 0.05;
    std::set<const Column*> even;
    for (const char* name : {"strain", "angular_frequency", "frequency", "time", "gap"}) {
        const Column* column = find_column(table(), name);
        if (column == nullptr || table().rows() < 3) {
            continue;
        }
        bool fits = true;
        for (std::size_t row = 1; row + 1 < table().rows(); ++row) {
            const double before = column->values[row - 1];
            const double value = column->values[row];
            const double after = column->values[row + 1];
            const double geometric = std::sqrt(before * after);
            const double arithmetic = 0.5 * (before + after);
            fits = fits && (std::abs(value - geometric) < slack * geometric || std::abs(value - arithmetic) < slack * arithmetic);
        }
        if (fits) {
            even.insert(column);
        }
    }
    return even;
}

bool Checker::all_rows_disagree(const Relation& relation, const RelationResult& result) {
    if (result.rows == 0 || static_cast<double>(result.failed) <= options_.most_failing * static_cast<double>(result.rows)) {
        return false;
    }
    if (relation.redundant != nullptr) {
        Column& column = this->column(relation.redundant->name);
        for (std::size_t row = 0; row < table().rows(); ++row) {
            if (std::isfinite(column.values[row])) {
                leave_out(column, row, "the whole column contradicts the others (" + relation.name + ")");
            }
        }
        if (!relation.is_of_raw_torque()) {
            contradicting_.push_back(column.name);
        }
        return true;
    }
    std::vector<double> ratios;
    for (std::size_t row = 0; row < table().rows(); ++row) {
        if (relation.readable(row)) {
            ratios.push_back(relation.ratio(relation.cells(row)));
        }
    }
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2), ratios.end());
    complain(relation.name + " fails in " + part_of(result.failed, result.rows) + " rows, typically by a factor of " +
             factor_text(ratios[ratios.size() / 2]) + ": are the units of these columns right?");
    return true;
}

void Checker::check_relations() {
    // A column that contradicts throughout is taken out first, so that it accuses no other.
    for (bool changed = true; changed;) {
        changed = false;
        const std::vector<Relation> relations = relations_of(table(), options_);
        checked_.relations.clear();
        for (const Relation& relation : relations) {
            RelationResult result{relation.name, 0, 0};
            for (std::size_t row = 0; row < table().rows(); ++row) {
                result.rows += relation.readable(row) ? 1 : 0;
                result.failed += relation.readable(row) && !relation.holds(relation.cells(row)) ? 1 : 0;
            }
            checked_.relations.push_back(result);
            if (all_rows_disagree(relation, result)) {
                changed = checked_.problems.empty();
                break;
            }
        }
        if (!changed && checked_.problems.empty()) {
            leave_out_suspects(relations);
        }
    }
    refuse_wrong_assignment();
}

/// One column may be wrong by itself. Several that contradict the others accuse these: values do not stand below their headings.
void Checker::refuse_wrong_assignment() {
    if (contradicting_.size() < 2) {
        return;
    }
    std::string names;
    std::string list;
    for (const std::string& name : contradicting_) {
        names += (names.empty() ? "'" : name == contradicting_.back() ? " and '" : ", '") + name + "'";
        list += (list.empty() ? "\"" : ", \"") + name + "\"";
    }
    complain("the columns " + names +
             " contradict the others in most rows: the values do not stand below their headings, or units are wrong; correct the "
             "file, or where the others are known to be right, leave these out by without = [" +
             list + "]");
}

/// The cells that alone explain every failing relation of the row; where no cell does, all that nothing vouches for.
std::set<const Column*> suspects_in(const std::vector<const Relation*>& failing, const std::set<const Column*>& vouched) {
    std::set<const Column*> all;
    for (const Relation* relation : failing) {
        if (relation->is_of_raw_torque()) {
            all.insert(relation->redundant);
            continue;
        }
        std::copy_if(relation->columns.begin(), relation->columns.end(), std::inserter(all, all.end()),
                     [&](const Column* column) { return !vouched.contains(column); });
    }
    std::set<const Column*> sufficient;
    std::copy_if(all.begin(), all.end(), std::inserter(sufficient, sufficient.end()), [&](const Column* column) {
        return std::all_of(failing.begin(), failing.end(), [&](const Relation* relation) {
            return std::find(relation->columns.begin(), relation->columns.end(), column) != relation->columns.end();
        });
    });
    return sufficient.empty() ? all : sufficient;
}

void Checker::leave_out_suspects(const std::vector<Relation>& relations) {
    const std::set<const Column*> even = evenly_stepped_columns();
    for (std::size_t row = 0; row < table().rows(); ++row) {
        std::set<const Column*> vouched = even;
        std::vector<const Relation*> failing;
        for (const Relation& relation : relations) {
            for (std::size_t i = 0; relation.readable(row) && i < relation.columns.size(); ++i) {
                if (relation.vouches_for(i, row)) {
                    vouched.insert(relation.columns[i]);
                }
            }
            if (relation.readable(row) && !relation.holds(relation.cells(row))) {
                failing.push_back(&relation);
            }
        }
        std::set<const Column*> suspects = suspects_in(failing, vouched);
        if (suspects.empty() && !failing.empty()) {  // all vouched for and yet contradicting: only what is set can be trusted
            suspects = suspects_in(failing, even);
        }
        for (const Column* suspect : suspects) {
            const auto relation = std::find_if(failing.begin(), failing.end(), [&](const Relation* each) {
                return std::find(each->columns.begin(), each->columns.end(), suspect) != each->columns.end();
            });
            const double ratio = (*relation)->ratio((*relation)->cells(row));
            leave_out(column(suspect->name), row,
                      (*relation)->name + " fails by a factor of " + factor_text(ratio) +
                          ((*relation)->is_of_raw_torque() ? ", as where the torque also turns the tool" : ""));
        }
    }
}

void Checker::check_what_is_left() {
    const std::vector<std::string> names = required_columns();
    std::size_t usable = 0;
    for (std::size_t row = 0; row < table().rows(); ++row) {
        const bool all = std::all_of(names.begin(), names.end(),
                                     [&](const std::string& name) { return std::isfinite(column(name).values[row]); });
        usable += all ? 1 : 0;
    }
    if (usable < rule_.fewest_rows) {
        complain(std::to_string(usable) + " usable rows are too few: a table of kind " + std::string(name_of(table().kind)) +
                 " needs at least " + std::to_string(rule_.fewest_rows));
        return;
    }
    for (const std::string& name : names) {
        const Column& values = column(name);
        const double first =
            *std::find_if(values.values.begin(), values.values.end(), [](double value) { return std::isfinite(value); });
        const bool set = name == "shear_rate" && table().kind == MeasurementKind::steady_shear;
        if (!set && std::all_of(values.values.begin(), values.values.end(),
                                [&](double value) { return !std::isfinite(value) || value == first; })) {
            complain("column '" + name + "' is " + to_text(first) + " " + values.unit +
                     " in every row, which no measurement gives");
        }
    }
    if (checked_.problems.empty() && table().kind == MeasurementKind::waveform && !harmonics_of(table())) {
        complain(needs_of_harmonics);
    }
}

}  // namespace

CheckedMeasurement check_data(const Measurement& measurement, const DataCheckOptions& options) {
    return Checker(measurement, options).run();
}

}  // namespace coagula::diagnose
