// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_axis.hpp"

#include <coagula/io/printable.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace coagula::report {

namespace {

constexpr double few_decades = 100;      // ratio of the ends below which powers of ten alone would be too few ticks
constexpr double least_relative = 1e-6;  // range over the size of the numbers, below which they are equal but for rounding

bool takes_prefix(const std::string& unit) {
    return unit == "m" || unit == "Pa" || unit == "N";
}

/// n of a unit such as "m-2", a power of 1 over a unit; 0 of any other.
int inverse_power(const std::string& unit) {
    const std::size_t dash = unit.find('-');
    const bool is_power =
        dash != std::string::npos && dash > 0 && dash + 2 == unit.size() && unit[dash + 1] >= '1' && unit[dash + 1] <= '9';
    return is_power ? unit[dash + 1] - '0' : 0;
}

/// The power of 1000 that brings the largest value between 1 and 1000; of the n-th power of a unit between 1 and 1000^n.
int prefix_power(double largest, int n = 1) {
    if (!(largest > 0)) {
        return 0;
    }
    return std::clamp(static_cast<int>(std::floor(std::log10(largest) / (3 * n) + 1e-9)), -4, 3);
}

/// Scale and unit in which the largest value is easy to read; angles are shown in degrees.
void choose_unit(double largest, SettledAxis& settled) {
    static constexpr std::array prefixes = {"p", "n", "µ", "m", "", "k", "M", "G"};
    const std::string& unit = settled.axis.unit;
    constexpr double degree = std::numbers::pi / 180;
    if (unit == "rad" || unit == "rad-1") {
        settled.scale = unit == "rad" ? degree : 1 / degree;
        settled.unit = unit == "rad" ? "°" : "1/°";
    } else if (const int n = inverse_power(unit); n > 0) {
        const std::string base = unit.substr(0, unit.size() - 2);
        const int power = takes_prefix(base) ? std::max(-3, prefix_power(largest, n)) : 0;
        settled.scale = std::pow(1000.0, power * n);
        settled.unit =
            std::string("1/") + prefixes.at(static_cast<std::size_t>(4 - power)) + base + (n > 1 ? std::to_string(n) : "");
    } else if (takes_prefix(unit)) {
        const int power = prefix_power(largest);
        settled.scale = std::pow(1000.0, power);
        const int place = power + 4;
        settled.unit = prefixes.at(static_cast<std::size_t>(place)) + unit;
    }
}

/// "m3" as "m^3" in gnuplot's markup.
std::string unit_markup(const std::string& unit) {
    std::string text;
    for (std::size_t k = 0; k < unit.size(); ++k) {
        const bool power = k > 0 && unit[k] >= '2' && unit[k] <= '9' && std::isalpha(static_cast<unsigned char>(unit[k - 1])) != 0;
        text += power ? std::string("^") + unit[k] : std::string(1, unit[k]);
    }
    return text;
}

/// 1, 2 or 5 times a power of ten, so that some six steps make the range.
double tick_distance(double range) {
    constexpr double ticks = 6;
    const double rough = range / ticks;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * power >= rough) {
            return digit * power;
        }
    }
    return 10 * power;
}

/// Places with a number on a logarithmic axis: powers of ten, over few decades 1, 2 and 5 times these, over less than one even
/// steps.
std::vector<double> numbered_places(double low, double high) {
    constexpr int most_numbers = 8;
    std::vector<double> places;
    if (high < 10 * low) {
        const double step = tick_distance(high - low);
        for (double k = std::ceil(low / step); k * step <= high; ++k) {
            places.push_back(k * step);
        }
        return places;
    }
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = static_cast<int>(std::floor(std::log10(high)));
    const int every = 1 + (last - first) / most_numbers;
    for (int power = first; power <= last; ++power) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double place = digit * std::pow(10.0, power);
            const bool wanted = digit == 1 ? power % every == 0 : high < few_decades * low;
            if (wanted && place >= low && place <= high) {
                places.push_back(place);
            }
        }
    }
    return places;
}

/// A number as gnuplot shows it: "2⋅10^{3}".
std::string as_power(double value) {
    const int power = static_cast<int>(std::floor(std::log10(value) + 1e-9));
    const double digits = std::round(value / std::pow(10.0, power) * 1e6) / 1e6;
    return (digits == 1 ? std::string{} : to_text(digits) + "⋅") + "10^{" +
           (power < 0 ? "−" + std::to_string(-power) : std::to_string(power)) + "}";
}

std::string six_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

/// Ticks with their numbers, and smaller ones at the whole multiples of powers of ten between.
std::string logarithmic_ticks(const SettledAxis& axis) {
    const bool even_steps = axis.high < 10 * axis.low;
    const bool powers = even_steps ? wants_powers(axis) : axis.powers;
    std::string ticks;
    for (const double place : numbered_places(axis.low, axis.high)) {
        ticks += (ticks.empty() ? "\"" : ", \"") + (powers ? as_power(place) : six_digits(place)) + "\" " + to_text(place);
    }
    for (int power = static_cast<int>(std::floor(std::log10(axis.low))); !even_steps && std::pow(10.0, power) <= axis.high;
         ++power) {
        for (int digit = 1; digit < 10; ++digit) {
            const double place = digit * std::pow(10.0, power);
            ticks += place < axis.low || place > axis.high ? std::string{} : ", \"\" " + to_text(place) + " 1";
        }
    }
    return ticks;
}

/// Digits in which neighbouring ticks differ.
int digits_of(const SettledAxis& axis) {
    const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
    const double digits = std::ceil(std::log10(largest / tick_distance(axis.high - axis.low)) + 1e-9) + 1;
    return std::clamp(static_cast<int>(digits), 4, 15);
}

/// A little more than the values on either side, where no end is asked for.
void widen(SettledAxis& settled) {
    const ChartAxis& axis = settled.axis;
    double below = 0;
    double above = 0;
    if (axis.logarithmic) {
        const double margin = std::max(std::pow(settled.high / settled.low, 0.06), 1.1);
        below = settled.low * (1 - 1 / margin);
        above = settled.high * (margin - 1);
    } else {
        const bool from_zero = axis.from_zero && settled.low >= 0;
        settled.low = from_zero ? 0 : settled.low;
        const double span = settled.high - settled.low;
        const double least = least_relative * std::max(std::abs(settled.low), std::abs(settled.high));
        above = span > 0 ? std::max(0.06 * span, 0.5 * (least - span)) : std::max(0.1 * std::abs(settled.high), 1e-12);
        below = from_zero ? 0 : above;
    }
    settled.low -= std::isfinite(axis.low) ? 0 : below;
    settled.high += std::isfinite(axis.high) ? 0 : above;
}

void check_range(const ChartAxis& axis, double low, double high) {
    const bool asked = std::isfinite(axis.low) || std::isfinite(axis.high);
    if (asked && axis.logarithmic && !(low > 0)) {
        throw InputError("the axis of " + axis.plain + " is logarithmic, so that its range must begin above zero, not at " +
                         to_text(low));
    }
    if (asked && !(high - low >= least_relative * std::max(std::abs(low), std::abs(high)))) {
        throw InputError("the axis of " + axis.plain + " would reach from " + to_text(low) + " to " + to_text(high) +
                         ": its upper end must lie above the lower one by a millionth at least");
    }
}

}  // namespace

SettledAxis settle(const ChartAxis& axis, const std::vector<double>& values) {
    SettledAxis settled{.axis = axis, .unit = axis.unit == "1" ? "" : axis.unit};
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values) {
        if (std::isfinite(value) && (!axis.logarithmic || value > 0)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (!(low <= high)) {
        low = axis.logarithmic ? 1 : 0;
        high = 10;
    }
    low = std::isfinite(axis.low) ? axis.low : low;
    high = std::isfinite(axis.high) ? axis.high : high;
    check_range(axis, low, high);
    choose_unit(std::max(std::abs(low), std::abs(high)), settled);
    settled.low = low / settled.scale;
    settled.high = high / settled.scale;
    widen(settled);
    return settled;
}

bool wants_powers(const SettledAxis& axis) {
    constexpr double least_plain = 0.01;
    constexpr double largest_plain = 1e4;
    const std::vector<double> places = axis.axis.logarithmic ? numbered_places(axis.low, axis.high) : std::vector<double>{};
    return std::any_of(places.begin(), places.end(),
                       [](double place) { return place < 0.999 * least_plain || place > 1.001 * largest_plain; });
}

std::string axis_commands(const SettledAxis& axis, const std::string& name) {
    const std::string range = "[" + to_text(axis.low) + ":" + to_text(axis.high) + "]\n";
    std::string commands = "set " + name + "range " + range;
    if (axis.axis.logarithmic) {
        commands += "set logscale " + name + "\nset " + name + "tics (" + logarithmic_ticks(axis) + ")\n";
    } else {
        commands += "set format " + name + " '%." + std::to_string(digits_of(axis)) + "h'\nset " + name + "tics " +
                    to_text(tick_distance(axis.high - axis.low)) + "\n";
    }
    const std::string unit = axis.unit.empty() ? "" : " (" + unit_markup(axis.unit) + ")";
    return commands + "set " + name + "label \"" + axis.axis.name + unit + "\"\n";
}

std::string quoted_text(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : io::printable(text)) {
        if (c == '\\' || c == '"') {
            quoted += std::string("\\") + c;
        } else if (c == '`' || c == '@') {  // commands and macros; the digits of an octal escape end with the quote
            quoted += std::string(c == '`' ? "\\140" : "\\100") + "\" . \"";
        } else {
            quoted += c;
        }
    }
    return quoted + "\"";
}

}  // namespace coagula::report
