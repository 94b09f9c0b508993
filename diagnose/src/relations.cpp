#include "relations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The columns by name; null where the table has none.
struct Columns {
    explicit Columns(const Measurement& table)
        : storage(find_column(table, "storage_modulus")),
          loss(find_column(table, "loss_modulus")),
          modulus(find_column(table, "complex_modulus")),
          tangent(find_column(table, "loss_tangent")),
          phase(find_column(table, "phase")),
          strain(find_column(table, "strain")),
          stress(find_column(table, "stress")),
          torque(find_column(table, "torque")),
          angular_frequency(find_column(table, "angular_frequency")),
          frequency(find_column(table, "frequency")),
          viscosity(find_column(table, "complex_viscosity")) {}

    const Column *storage, *loss, *modulus, *tangent, *phase, *strain, *stress, *torque, *angular_frequency, *frequency, *viscosity;

    double complex_modulus(std::size_t row) const { return std::hypot(storage->values[row], loss->values[row]); }
};

/// Collects the relations whose columns are all there.
class RelationList {
public:
    explicit RelationList(double tolerance) : tolerance_(tolerance) {}

    template <class Ratio>
    void add(std::string name, std::vector<const Column*> columns, const Column* redundant, Ratio ratio) {
        add(std::move(name), std::move(columns), redundant, ratio, [limit = tolerance_](std::size_t) { return limit; });
    }

    template <class Ratio, class Tolerance>
    void add(std::string name, std::vector<const Column*> columns, const Column* redundant, Ratio ratio, Tolerance tolerance) {
        if (std::find(columns.begin(), columns.end(), nullptr) == columns.end()) {
            list.push_back({std::move(name), std::move(columns), redundant, ratio, tolerance});
        }
    }

    /// Two quantities whose ratio is one constant of the tool, taken as the median of the table.
    template <class Ratio>
    void add_proportional(std::string name, std::vector<const Column*> columns, const Column* redundant, Ratio ratio,
                          double tolerance) {
        if (std::find(columns.begin(), columns.end(), nullptr) != columns.end()) {
            return;
        }
        std::vector<double> ratios;
        for (std::size_t row = 0; row < columns.front()->values.size(); ++row) {
            if (std::isfinite(ratio(row))) {
                ratios.push_back(ratio(row));
            }
        }
        if (!ratios.empty()) {
            const double constant = median(ratios);
            add(
                std::move(name), std::move(columns), redundant, [=](std::size_t row) { return ratio(row) / constant; },
                [tolerance](std::size_t) { return tolerance; });
        }
    }

    std::vector<Relation> list;

private:
    double tolerance_;
};

void add_moduli(RelationList& relations, const Columns& c, const DataCheckOptions& options) {
    relations.add(
        "G''/G' = tan delta", {c.storage, c.loss, c.tangent}, c.tangent,
        [c](std::size_t row) { return c.loss->values[row] / (c.storage->values[row] * c.tangent->values[row]); },
        [c, options](std::size_t row) {
            return options.tolerance + options.loss_tangent_resolution / std::abs(c.tangent->values[row]);
        });
    relations.add(
        "G''/G' = tan(phase)", {c.storage, c.loss, c.phase}, c.phase,
        [c](std::size_t row) { return c.loss->values[row] / (c.storage->values[row] * std::tan(c.phase->values[row])); },
        [c, options](std::size_t row) {
            return options.tolerance + options.loss_tangent_resolution / std::abs(std::tan(c.phase->values[row]));
        });
    relations.add("|G' + i G''| = |G*|", {c.storage, c.loss, c.modulus}, c.modulus,
                  [c](std::size_t row) { return c.complex_modulus(row) / c.modulus->values[row]; });
    relations.add(
        "|G*| = angular frequency x |eta*|", {c.storage, c.loss, c.angular_frequency, c.viscosity}, c.viscosity,
        [c](std::size_t row) { return c.complex_modulus(row) / (c.angular_frequency->values[row] * c.viscosity->values[row]); });
    relations.add("angular frequency = 2 pi frequency", {c.angular_frequency, c.frequency}, c.frequency, [c](std::size_t row) {
        return c.angular_frequency->values[row] / (2 * std::numbers::pi * c.frequency->values[row]);
    });
}

void add_stress(RelationList& relations, const Columns& c, double peak_tolerance, double tolerance) {
    const auto strained = [c](std::size_t row) { return c.complex_modulus(row) * c.strain->values[row]; };
    relations.add(
        "|G*| x strain = stress", {c.storage, c.loss, c.strain, c.stress}, nullptr,
        [c, strained](std::size_t row) { return strained(row) / c.stress->values[row]; },
        [peak_tolerance](std::size_t) { return peak_tolerance; });
    relations.add_proportional(
        "torque proportional to stress", {c.torque, c.stress}, c.torque,
        [c](std::size_t row) { return c.torque->values[row] / c.stress->values[row]; }, tolerance);
    if (c.storage != nullptr && c.loss != nullptr && c.strain != nullptr) {
        relations.add_proportional(
            "torque proportional to |G*| x strain", {c.torque, c.storage, c.loss, c.strain}, c.torque,
            [c, strained](std::size_t row) { return c.torque->values[row] / strained(row); }, peak_tolerance);
    }
}

}  // namespace

bool Relation::readable(std::size_t row) const {
    return std::all_of(columns.begin(), columns.end(), [&](const Column* column) { return std::isfinite(column->values[row]); });
}

bool Relation::holds(std::size_t row) const {
    const double value = ratio(row);
    return value > 0 && std::abs(std::log(value)) <= tolerance(row);
}

std::vector<Relation> relations_of(const Measurement& measurement, const DataCheckOptions& options) {
    if (measurement.kind == MeasurementKind::waveform) {
        return {};
    }
    const Columns columns(measurement);
    RelationList relations(options.tolerance);
    add_moduli(relations, columns, options);
    const bool peaks = measurement.kind == MeasurementKind::amplitude_sweep;
    add_stress(relations, columns, peaks ? std::log1p(options.peak_tolerance) : options.tolerance, options.tolerance);
    return std::move(relations.list);
}

}  // namespace coagula::diagnose
