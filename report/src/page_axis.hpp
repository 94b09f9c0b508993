// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of the figures of a page: what they show, in which unit, linear or logarithmic.
#pragma once

#include <coagula/report/results.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace coagula::report {

struct PageAxis {
    std::string label;
    double unit = 1;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void include(double value) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    bool logarithmic() const {
        constexpr double log_from = 8;  // ratio of largest to smallest value
        return low > 0 && high > log_from * low;
    }
    Json json() const { return {{"label", label}, {"logarithmic", logarithmic()}}; }
};

/// How a coordinate is written.
struct WrittenCoordinate {
    std::string_view name;    ///< that of its column
    std::string_view label;   ///< of an axis
    std::string_view words;   ///< in a sentence
    std::string_view symbol;  ///< of the unit after a value in a sentence
    double unit = 1;          ///< in SI units
};

inline constexpr std::array written_coordinates{
    WrittenCoordinate{"strain", "strain amplitude γ₀ [%]", "strain", " %", 0.01},
    WrittenCoordinate{"angular_frequency", "angular frequency ω [rad/s]", "angular frequency", " rad/s"},
    WrittenCoordinate{"time", "time t [s]", "time", " s"},
    WrittenCoordinate{"shear_rate", "shear rate [1/s]", "shear_rate", " 1/s"},
    WrittenCoordinate{"gap", "gap h [mm]", "gap", " mm", 1e-3},
    WrittenCoordinate{"plate_radius", "plate radius R [mm]", "plate radius", " mm", 1e-3},
    WrittenCoordinate{"heterogeneity", "degree of heterogeneity a", "heterogeneity", ""},
    WrittenCoordinate{"coordination", "coordination number C", "coordination", ""},
    WrittenCoordinate{"volume_fraction", "volume fraction φ", "volume_fraction", ""},
    WrittenCoordinate{"distance", "distance [diameters]", "distance", " diameters"},
    WrittenCoordinate{"pore_radius", "distance from the nearest particle surface [µm]", "pore_radius", " um", 1e-6}};

/// A coordinate that the list lacks is written as its name.
inline WrittenCoordinate written_coordinate(std::string_view name) {
    const auto* const found = std::find_if(written_coordinates.begin(), written_coordinates.end(),
                                           [&](const WrittenCoordinate& one) { return one.name == name; });
    return found != written_coordinates.end() ? *found : WrittenCoordinate{name, "row", name, ""};
}

/// The axis of a table by the name of its column.
inline PageAxis axis_named(std::string_view name) {
    const WrittenCoordinate found = written_coordinate(name);
    return {.label = std::string(found.label), .unit = found.unit};
}

/// The unit that a modulus is shown in.
inline PageAxis modulus_axis(double largest) {
    static constexpr std::array units{std::pair{1e9, "GPa"}, std::pair{1e6, "MPa"}, std::pair{1e3, "kPa"}};
    for (const auto& [unit, name] : units) {
        if (largest >= unit) {
            return {.label = std::string("G′, G″ [") + name + "]", .unit = unit};
        }
    }
    return {.label = "G′, G″ [Pa]"};
}

/// The unit that a viscosity is shown in.
inline PageAxis viscosity_axis(double largest) {
    return largest < 1 ? PageAxis{.label = "viscosity [mPa s]", .unit = 1e-3} : PageAxis{.label = "viscosity [Pa s]"};
}

inline Json finite_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace coagula::report
