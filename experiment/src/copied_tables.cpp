// SPDX-License-Identifier: GPL-3.0-or-later
#include "copied_tables.hpp"

#include <coagula/experiment/measured_tables.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace coagula::experiment {

namespace {

using diagnose::Column;
using diagnose::Measurement;

/// What a sample answers, in which no two measurements agree to the last digit.
constexpr std::array<std::string_view, 10> responses = {
    "storage_modulus",     "loss_modulus", "complex_modulus", "viscosity",  "third_harmonic_storage",
    "third_harmonic_loss", "torque",       "stress",          "compliance", "relaxation_modulus"};

bool has_same_numbers(const Measurement& one, const Measurement& other) {
    const auto alike = [](const Column& a, const Column& b) { return a.name == b.name && same_values(a.values, b.values); };
    return one.kind == other.kind &&
           std::equal(one.columns.begin(), one.columns.end(), other.columns.begin(), other.columns.end(), alike);
}

/// The number of so many significant digits that is nearest.
double rounded(double value, int digits) {
    if (value == 0) {
        return 0;
    }
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
    return unit * std::round(value / unit);
}

/// Whether one value is the other with so many significant digits; a half may be rounded either way.
bool is_rounded(double coarse, double fine, int digits) {
    constexpr double of_binary = 1e-9;
    if (std::isnan(coarse) || std::isnan(fine)) {
        return std::isnan(coarse) && std::isnan(fine);
    }
    const double unit = std::abs(rounded(fine, digits)) * std::pow(10.0, -digits);
    const bool has_digits = std::abs(rounded(coarse, digits) - coarse) <= of_binary * std::abs(coarse);
    const double nudge = 1e-6 * unit * (fine > 0 ? 1 : -1);
    const auto is = [&](double value) { return std::abs(value - coarse) <= of_binary * std::abs(coarse); };
    return has_digits && (is(rounded(fine, digits)) || is(rounded(fine + nudge, digits)) || is(rounded(fine - nudge, digits)));
}

/// Whether one value is the other with so many places behind the point, counted from the largest number of the column.
bool is_cut(double coarse, double fine, double unit) {
    constexpr double of_unit = 1e-6;
    if (std::isnan(coarse) || std::isnan(fine)) {
        return std::isnan(coarse) && std::isnan(fine);
    }
    return std::abs(coarse - unit * std::round(coarse / unit)) <= of_unit * unit &&
           std::abs(coarse - fine) <= (0.5 + of_unit) * unit;
}

/// Whether a column is another one with fewer digits, as many in every row or as many places in every row.
bool is_rounded(const Column& coarse, const Column& fine) {
    constexpr int fewest_digits = 3;
    constexpr int most_digits = 9;
    const auto all = [&](const auto& agree) {
        return std::equal(coarse.values.begin(), coarse.values.end(), fine.values.begin(), fine.values.end(), agree);
    };
    double smallest = 0;
    for (const double value : fine.values) {
        smallest = std::abs(value) > 0 && (smallest == 0 || std::abs(value) < smallest) ? std::abs(value) : smallest;
    }
    for (int digits = fewest_digits; digits <= most_digits; ++digits) {
        const double unit = std::pow(10.0, std::floor(std::log10(smallest)) + 1 - digits);
        if (all([&](double a, double b) { return is_rounded(a, b, digits); }) ||
            (smallest > 0 && all([&](double a, double b) { return is_cut(a, b, unit); }))) {
            return true;
        }
    }
    return false;
}

/// Whether all responses that both tables have are those of the other with fewer digits, or the same.
bool is_rounded(const Measurement& coarse, const Measurement& fine) {
    constexpr std::size_t fewest_numbers = 5;
    std::size_t numbers = 0;
    for (const std::string_view name : responses) {
        const Column* one = diagnose::find_column(coarse, name);
        const Column* other = diagnose::find_column(fine, name);
        if (one == nullptr || other == nullptr) {
            continue;
        }
        if (!same_values(one->values, other->values) && !is_rounded(*one, *other)) {
            return false;
        }
        numbers += static_cast<std::size_t>(
            std::count_if(one->values.begin(), one->values.end(), [](double value) { return std::isfinite(value); }));
    }
    return numbers >= fewest_numbers;
}

}  // namespace

Likeness likeness(const Measurement& one, const Measurement& other) {
    if (has_same_numbers(one, other)) {
        return Likeness::same_numbers;
    }
    const bool comparable = one.kind == other.kind && one.rows() == other.rows();
    return comparable && (is_rounded(one, other) || is_rounded(other, one)) ? Likeness::rounded : Likeness::none;
}

}  // namespace coagula::experiment
