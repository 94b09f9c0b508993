// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/stress_control.hpp>

#include "median.hpp"
#include "table_cells.hpp"

#include <cmath>

namespace coagula::diagnose {

namespace {

/// Stress of a row, or what is proportional to it.
double stress_in(const Measurement& table, std::size_t row) {
    for (const char* name : {"stress", "torque"}) {
        if (find_column(table, name) != nullptr) {
            return std::abs(cell(table, name, row));
        }
    }
    return cell(table, "strain", row) * complex_modulus(table, row);
}

/// Steps from row to row in which one of two quantities stays while the other changes.
std::size_t steps_of_second_alone(const std::vector<double>& first, const std::vector<double>& second) {
    constexpr double same = 0.01;
    constexpr double other = 0.03;
    std::size_t steps = 0;
    for (std::size_t row = 1; row < first.size(); ++row) {
        const double step = std::abs(std::log(first[row] / first[row - 1]));
        const double other_step = std::abs(std::log(second[row] / second[row - 1]));
        steps += step < same && other_step > other ? 1 : 0;
    }
    return steps;
}

struct Amplitudes {
    std::vector<double> strain;
    std::vector<double> stress;
};

Amplitudes amplitudes_of(const Measurement& table) {
    Amplitudes amplitudes;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        amplitudes.strain.push_back(cell(table, "strain", row));
        amplitudes.stress.push_back(stress_in(table, row));
    }
    return amplitudes;
}

}  // namespace

bool is_stress_controlled(const Measurement& table) {
    if (table.stress_controlled || find_column(table, "strain") == nullptr) {
        return table.stress_controlled.value_or(false);
    }
    constexpr std::size_t fewest = 3;
    const auto [strain, stress] = amplitudes_of(table);
    const std::size_t of_strain = steps_of_second_alone(stress, strain);
    const std::size_t of_stress = steps_of_second_alone(strain, stress);
    return of_strain >= fewest && 3 * of_strain >= table.rows() && of_strain > 4 * of_stress;
}

std::vector<double> set_strains(const Measurement& table) {
    auto [strain, stress] = amplitudes_of(table);
    if (table.kind == MeasurementKind::amplitude_sweep || !is_stress_controlled(table)) {
        return strain;
    }
    std::vector<double> ratios;
    for (std::size_t row = 0; row < strain.size(); ++row) {
        if (stress[row] > 0 && strain[row] > 0) {
            ratios.push_back(stress[row] / strain[row]);
        }
    }
    const double middle = ratios.empty() ? unset : median(ratios);
    for (double& value : stress) {
        value /= middle;
    }
    return stress;
}

}  // namespace coagula::diagnose
