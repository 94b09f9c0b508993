// What the pictures of a diagnosis share: colours, axes, lines of numbers for gnuplot.
#pragma once

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace coagula::report {

/// Colours of Okabe and Ito (2008).
inline const std::string palette = R"(
base = "#d55e00"; extended = "#0072b2"; smooth = "#8a8f94"; ink = "#1d2329"
set border 3 linecolor rgb "#5b6770" linewidth 0.8
set tics nomirror out textcolor rgb ink scale 0.6
set grid linecolor rgb "#e4e8eb" linetype 1 linewidth 0.7
)";

/// One axis of a picture: what it shows, in which unit, over which range.
struct PlotAxis {
    std::string label;
    double unit = 1;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(double value) {
        if (std::isfinite(value)) {
            low = std::min(low, value / unit);
            high = std::max(high, value / unit);
        }
    }
    bool logarithmic() const {
        constexpr double log_from = 8;  // ratio of largest to smallest value
        return low > 0 && high > log_from * low;
    }
    /// Commands for axis "x" or "y", a little wider than the values.
    std::string commands(const std::string& name) const {
        double from = low;
        double to = high;
        if (logarithmic()) {
            const double margin = std::pow(high / low, 0.04);
            from = low / margin;
            to = high * margin;
        } else {
            const double margin = high > low ? 0.06 * (high - low) : std::max(0.1 * std::abs(high), 1e-12);
            from = low - margin;
            to = high + margin;
        }
        return (logarithmic() ? "set logscale " : "unset logscale ") + name + "\nset " + name + "range [" + to_text(from) + ":" +
               to_text(to) + "]\nset format " + name + " \"%g\"\n";
    }
};

inline std::string number_text(double value) {
    return std::isfinite(value) ? to_text(value) : "NaN";
}

inline std::string line_of(const std::vector<double>& values) {
    std::string line;
    for (const double value : values) {
        line += (line.empty() ? "" : " ") + number_text(value);
    }
    return line + "\n";
}

}  // namespace coagula::report
