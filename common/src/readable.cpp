// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/readable.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace coagula {

namespace {

/// The power of 1000 that brings a value between 1 and 1000, as an SI prefix between pico and giga.
int thousands(double value) {
    if (value == 0 || !std::isfinite(value)) {
        return 0;
    }
    const int power = static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-9));
    return std::min(std::max(power, -4), 3);
}

std::string digits(double value) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.5g", value);
    return buffer.data();
}

}  // namespace

std::string with_unit(double value, const std::string& unit) {
    if (unit == "1" || unit.empty()) {
        return digits(value);
    }
    static constexpr std::array prefixes = {"p", "n", "u", "m", "", "k", "M", "G"};
    const int power = unit == "m" || unit == "Pa" || unit == "N/m" ? thousands(value) : 0;
    const int place = power + 4;
    return digits(value / std::pow(1000.0, power)) + ' ' + prefixes[static_cast<std::size_t>(place)] + unit;
}

std::string with_error(double value, double error) {
    const bool has_error = std::isfinite(error) && error > 0;
    const int decimals = has_error ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12) : 5;
    std::array<char, 64> buffer{};
    if (std::isfinite(error)) {
        std::snprintf(buffer.data(), buffer.size(), "%.*f +- %.*f", decimals, value, decimals, error);
    } else {
        std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
    }
    return buffer.data();
}

std::string describe_periodicity(const Cell& cell) {
    if (cell.is_periodic() || cell.is_open()) {
        return cell.is_open() ? "open" : "periodic";
    }
    const char* const names = cell.is_rectangular() ? "xyz" : "abc";
    std::string axes;
    for (int axis = 0; axis < 3; ++axis) {
        axes += cell.is_periodic(axis) ? (axes.empty() ? "" : " and ") + std::string(1, names[axis]) : "";
    }
    return "periodic along " + axes;
}

std::string describe(const Cell& cell) {
    std::string text;
    for (const double length : cell.edge_lengths()) {
        text += (text.empty() ? "" : " x ") + with_unit(length, "m");
    }
    return text + (cell.is_rectangular() ? "" : ", tilted") + ", " + describe_periodicity(cell);
}

}  // namespace coagula
