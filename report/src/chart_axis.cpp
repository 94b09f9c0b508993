#include "chart_axis.hpp"

#include <coagula/report/printable.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

constexpr double few_decades = 100;  // ratio of the ends below which powers of ten alone would be too few ticks

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

/// Scale and unit in which the largest value is easy to read.
void choose_unit(double largest, SettledAxis& settled) {
    static constexpr std::array prefixes = {"p", "n", "µ", "m", "", "k", "M", "G"};
    const std::string& unit = settled.axis.unit;
    if (const int n = inverse_power(unit); n > 0) {
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

/// Of a logarithmic axis of few decades: 1, 2 and 5 times powers of ten, or equal steps where it has less than one decade.
std::string ticks_between(double low, double high) {
    std::vector<double> places;
    if (high < 10 * low) {
        const double step = tick_distance(high - low);
        for (double k = std::ceil(low / step); k * step <= high; ++k) {
            places.push_back(k * step);
        }
    } else {
        for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                places.push_back(digit * std::pow(10.0, power));
            }
        }
    }
    std::string ticks;
    for (const double place : places) {
        ticks += (ticks.empty() ? "" : ",") + to_text(place);
    }
    return ticks;
}

/// A little more than the values on either side.
void widen(SettledAxis& settled) {
    const ChartAxis& axis = settled.axis;
    if (axis.logarithmic) {
        const double margin = std::max(std::pow(settled.high / settled.low, 0.06), 1.1);
        settled.low /= margin;
        settled.high *= margin;
        return;
    }
    const bool from_zero = axis.from_zero && settled.low >= 0;
    const double span = from_zero ? settled.high : settled.high - settled.low;
    const double margin = span > 0 ? 0.06 * span : std::max(0.1 * std::abs(settled.high), 1e-12);
    settled.low = from_zero ? 0 : settled.low - margin;
    settled.high += margin;
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
    choose_unit(std::max(std::abs(low), std::abs(high)), settled);
    settled.low = low / settled.scale;
    settled.high = high / settled.scale;
    widen(settled);
    if (std::isfinite(axis.low)) {
        settled.low = axis.low / settled.scale;
    }
    if (std::isfinite(axis.high)) {
        settled.high = axis.high / settled.scale;
    }
    return settled;
}

std::string axis_commands(const SettledAxis& axis, const std::string& name) {
    const std::string range = "[" + to_text(axis.low) + ":" + to_text(axis.high) + "]\n";
    std::string commands = "set " + name + "range " + range + "set format " + name + " '%g'\n";
    if (axis.axis.logarithmic) {
        commands += "set logscale " + name + "\n";
        if (axis.high / axis.low < few_decades) {
            commands += "set " + name + "tics (" + ticks_between(axis.low, axis.high) + ")\n";
            if (axis.high < 0.01) {
                commands += "set format " + name + " '%.0l⋅10^{%T}'\n";
            }
        } else {
            commands += "set format " + name + " '10^{%T}'\n";
        }
    } else {
        commands += "set " + name + "tics " + to_text(tick_distance(axis.high - axis.low)) + "\n";
    }
    const std::string unit = axis.unit.empty() ? "" : " (" + unit_markup(axis.unit) + ")";
    return commands + "set " + name + "label \"" + axis.axis.name + unit + "\"\n";
}

std::string quoted_text(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : printable(text)) {
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
