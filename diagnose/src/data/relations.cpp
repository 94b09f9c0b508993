// SPDX-License-Identifier: GPL-3.0-or-later
#include "relations.hpp"

#include "median.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

using Cells = Relation::Cells;

/// Collects the relations whose columns are all there.
class RelationList {
public:
    RelationList(const Measurement& table, double tolerance) : table_(table), tolerance_(tolerance) {}

    /// @param redundant name of the column that only repeats the others, or empty.
    template <class Ratio, class Tolerance>
    void add(std::string name, const std::vector<const char*>& columns, const std::string& redundant, Ratio ratio,
             Tolerance tolerance) {
        Relation relation{std::move(name), {}, nullptr, ratio, tolerance};
        for (const char* column : columns) {
            const Column* found = find_column(table_, column);
            if (found == nullptr) {
                return;
            }
            relation.columns.push_back(found);
            relation.redundant = redundant == column ? found : relation.redundant;
        }
        list.push_back(std::move(relation));
    }

    template <class Ratio>
    void add(std::string name, const std::vector<const char*>& columns, const std::string& redundant, Ratio ratio) {
        add(std::move(name), columns, redundant, ratio, [limit = tolerance_](const Cells&) { return limit; });
    }

    /// Two quantities whose ratio is one constant of the tool, taken as the median of the table.
    template <class Ratio>
    void add_proportional(std::string name, const std::vector<const char*>& columns, const std::string& redundant, Ratio ratio,
                          double limit) {
        const std::size_t before = list.size();
        add(std::move(name), columns, redundant, ratio, [limit](const Cells&) { return limit; });
        if (list.size() == before) {
            return;
        }
        std::vector<double> ratios;
        for (std::size_t row = 0; row < table_.rows(); ++row) {
            if (list.back().readable(row)) {
                ratios.push_back(ratio(list.back().cells(row)));
            }
        }
        if (ratios.empty()) {
            list.pop_back();
            return;
        }
        list.back().ratio = [ratio, constant = median(ratios)](const Cells& cells) { return ratio(cells) / constant; };
    }

    std::vector<Relation> list;

private:
    const Measurement& table_;
    double tolerance_;
};

void add_moduli(RelationList& relations, const DataCheckOptions& options) {
    const auto rounded = [options](double tangent) {
        return options.tolerance + options.loss_tangent_resolution / std::abs(tangent);
    };
    relations.add(
        "G''/G' = tan delta", {"storage_modulus", "loss_modulus", "loss_tangent"}, "loss_tangent",
        [](const Cells& c) { return c[1] / (c[0] * c[2]); }, [rounded](const Cells& c) { return rounded(c[2]); });
    relations.add(
        "G''/G' = tan(phase)", {"storage_modulus", "loss_modulus", "phase"}, "phase",
        [](const Cells& c) { return c[1] / (c[0] * std::tan(c[2])); },
        [rounded](const Cells& c) { return rounded(std::tan(c[2])); });
    relations.add("|G' + i G''| = |G*|", {"storage_modulus", "loss_modulus", "complex_modulus"}, "complex_modulus",
                  [](const Cells& c) { return std::hypot(c[0], c[1]) / c[2]; });
    relations.add("|G*| = angular frequency x |eta*|",
                  {"storage_modulus", "loss_modulus", "angular_frequency", "complex_viscosity"}, "complex_viscosity",
                  [](const Cells& c) { return std::hypot(c[0], c[1]) / (c[2] * c[3]); });
    relations.add("angular frequency = 2 pi frequency", {"angular_frequency", "frequency"}, "frequency",
                  [](const Cells& c) { return c[0] / (2 * std::numbers::pi * c[1]); });
}

void add_stress(RelationList& relations, double peak_tolerance, double tolerance) {
    relations.add(
        "|G*| x strain = stress", {"storage_modulus", "loss_modulus", "strain", "stress"}, "",
        [](const Cells& c) { return std::hypot(c[0], c[1]) * c[2] / c[3]; },
        [peak_tolerance](const Cells&) { return peak_tolerance; });
    relations.add_proportional(
        "torque proportional to stress", {"torque", "stress"}, "torque", [](const Cells& c) { return c[0] / c[1]; }, tolerance);
    relations.add_proportional(
        "torque proportional to |G*| x strain", {"torque", "storage_modulus", "loss_modulus", "strain"}, "torque",
        [](const Cells& c) { return c[0] / (std::hypot(c[1], c[2]) * c[3]); }, peak_tolerance);
}

}  // namespace

Relation::Cells Relation::cells(std::size_t row) const {
    Cells values;
    for (const Column* column : columns) {
        values.push_back(column->values[row]);
    }
    return values;
}

bool Relation::readable(std::size_t row) const {
    return std::all_of(columns.begin(), columns.end(), [&](const Column* column) { return std::isfinite(column->values[row]); });
}

bool Relation::holds(const Cells& values) const {
    const double value = ratio(values);
    return value > 0 && std::abs(std::log(value)) <= tolerance(values);
}

bool Relation::vouches_for(std::size_t column, std::size_t row) const {
    constexpr double gross = 2;
    Cells values = cells(row);
    if (!holds(values)) {
        return false;
    }
    const double cell = values[column];
    values[column] = cell * gross;
    const bool too_large_is_seen = !holds(values);
    values[column] = cell / gross;
    return too_large_is_seen && !holds(values);
}

std::vector<Relation> relations_of(const Measurement& measurement, const DataCheckOptions& options) {
    if (measurement.kind == MeasurementKind::waveform) {
        return {};
    }
    RelationList relations(measurement, options.tolerance);
    add_moduli(relations, options);
    const bool peaks = measurement.kind == MeasurementKind::amplitude_sweep;
    add_stress(relations, peaks ? std::log1p(options.peak_tolerance) : options.tolerance, options.tolerance);
    return std::move(relations.list);
}

}  // namespace coagula::diagnose
