// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of the figures of a page: what they show, in which unit, linear or logarithmic.
#pragma once

#include <coagula/report/results.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
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

/// The axis of a table by the name of its column.
inline PageAxis axis_named(const std::string& name) {
    static const std::map<std::string, std::pair<std::string, double>> known{
        {"strain", {"strain amplitude γ₀ [%]", 0.01}},
        {"angular_frequency", {"angular frequency ω [rad/s]", 1.0}},
        {"time", {"time t [s]", 1.0}},
        {"shear_rate", {"shear rate [1/s]", 1.0}},
        {"gap", {"gap h [mm]", 1e-3}},
        {"heterogeneity", {"degree of heterogeneity a", 1.0}},
        {"coordination", {"coordination number C", 1.0}},
        {"volume_fraction", {"volume fraction φ", 1.0}},
        {"distance", {"distance [diameters]", 1.0}},
        {"pore_radius", {"distance from the nearest particle surface [µm]", 1e-6}}};
    const auto found = known.find(name);
    return found == known.end() ? PageAxis{.label = "row"} : PageAxis{.label = found->second.first, .unit = found->second.second};
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
