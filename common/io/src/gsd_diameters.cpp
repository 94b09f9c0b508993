// SPDX-License-Identifier: GPL-3.0-or-later
#include "gsd_diameters.hpp"

#include <coagula/common/checks.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "gsd_container.hpp"

namespace coagula::io {

namespace {

constexpr double largest_type = 4294967296;  ///< types are of 32 bit
constexpr double rounding = 1e-6;            ///< of single precision

bool nearly_equal(double a, double b) {
    return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// Diameters and shapes that the file gives for each type of particle.
struct Types {
    std::vector<std::string> names;
    std::vector<std::string> shapes;               ///< JSON objects of particles/type_shapes
    std::vector<double> sphere_radii;              ///< of Monte Carlo
    std::array<std::vector<double>, 3> half_axes;  ///< of the ellipsoids of Monte Carlo
    std::string other_shape;                       ///< of Monte Carlo, such as "convex_polyhedron"

    std::string name(std::size_t type) const { return "type '" + (type < names.size() ? names[type] : std::to_string(type)) + "'"; }
};

/// The shape of Monte Carlo that is neither a sphere nor an ellipsoid: "state/hpmc/SHAPE/...".
std::string other_monte_carlo_shape(const GsdFile& file) {
    static const std::string folder = "state/hpmc/";
    for (const std::string& name : file.names()) {
        if (!name.starts_with(folder)) {
            continue;
        }
        std::string shape = name.substr(folder.size(), name.find('/', folder.size()) - folder.size());
        if (shape != "integrate" && shape != "sphere" && shape != "ellipsoid") {
            return shape;
        }
    }
    return "";
}

Types types_of(const GsdFile& file, std::uint64_t frame) {
    Types types;
    types.names = file.texts_or_first(frame, "particles/types");
    types.shapes = file.texts_or_first(frame, "particles/type_shapes");
    types.sphere_radii = file.numbers_or_first(frame, "state/hpmc/sphere/radius");
    for (std::size_t axis = 0; axis < 3; ++axis) {
        types.half_axes[axis] = file.numbers_or_first(frame, std::string("state/hpmc/ellipsoid/") + "abc"[axis]);
    }
    types.other_shape = other_monte_carlo_shape(file);
    return types;
}

[[noreturn]] void fail_by_shape(const GsdFile& file, const std::string& type, const std::string& shape) {
    file.fail("particles of " + type + " have the shape " + shape +
              ", but coagula reads spheres; give --radius to take their centres");
}

/// The diameter of the ellipsoid with these half axes, which must be a sphere.
double diameter_of_ellipsoid(const GsdFile& file, const std::string& type, double a, double b, double c) {
    if (!nearly_equal(a, b) || !nearly_equal(a, c)) {
        fail_by_shape(file, type, "Ellipsoid");
    }
    return 2 * a;
}

/// Reads the diameter of a shape such as {"type": "Sphere", "diameter": 2}; there is none for {}.
std::optional<double> diameter_of_shape(const GsdFile& file, const std::string& type, const std::string& text) {
    const auto shape = nlohmann::json::parse(text.empty() ? "{}" : text, nullptr, false);
    if (!shape.is_object()) {
        file.fail("the shape of " + type + " in 'particles/type_shapes' is no JSON object");
    }
    if (!shape.contains("type")) {
        return std::nullopt;
    }
    const std::string kind = shape["type"].is_string() ? shape["type"].get<std::string>() : shape["type"].dump();
    const auto length = [&](const char* key) {
        if (!shape.contains(key) || !shape[key].is_number()) {
            file.fail("the " + kind + " of " + type + " in 'particles/type_shapes' has no number '" + key + "'");
        }
        return shape[key].get<double>();
    };
    if (kind == "Sphere") {
        return length("diameter");
    }
    if (kind == "Ellipsoid") {
        return diameter_of_ellipsoid(file, type, length("a"), length("b"), length("c"));
    }
    fail_by_shape(file, type, kind);
}

/// The diameter that the state of a Monte Carlo simulation gives to a type.
std::optional<double> diameter_of_state(const GsdFile& file, const Types& types, std::size_t type) {
    if (type < types.sphere_radii.size()) {
        return 2 * types.sphere_radii[type];
    }
    const auto& [a, b, c] = types.half_axes;
    if (type < a.size() && type < b.size() && type < c.size()) {
        return diameter_of_ellipsoid(file, types.name(type), a[type], b[type], c[type]);
    }
    if (!types.other_shape.empty()) {
        fail_by_shape(file, types.name(type), types.other_shape);
    }
    return std::nullopt;
}

std::optional<double> diameter_of_type(const GsdFile& file, const Types& types, std::size_t type) {
    const auto shape = type < types.shapes.size() ? diameter_of_shape(file, types.name(type), types.shapes[type]) : std::nullopt;
    const auto state = diameter_of_state(file, types, type);
    if (shape && state && !nearly_equal(*shape, *state)) {
        file.fail("the sphere of " + types.name(type) + " has the diameter " + to_text(*shape) +
                  " in 'particles/type_shapes', but " + to_text(*state) + " in the state of Monte Carlo; give --radius");
    }
    return shape ? shape : state;
}

}  // namespace

std::vector<double> gsd_diameters(const GsdFile& file, std::uint64_t frame, std::size_t count) {
    const Types types = types_of(file, frame);
    const std::vector<double> stored = file.values(frame, "particles/diameter", count, 1);
    std::vector<double> number = file.values(frame, "particles/typeid", count, 1);
    number.resize(count, 0.0);
    std::map<double, std::optional<double>> by_type;
    std::vector<double> diameters(count, 1.0);  // the default of the schema, which is not stored
    for (std::size_t particle = 0; particle < count; ++particle) {
        if (!(number[particle] >= 0 && number[particle] < largest_type)) {
            file.fail("'particles/typeid' of frame " + std::to_string(frame) + " has the type " + to_text(number[particle]));
        }
        const auto [entry, is_new] = by_type.try_emplace(number[particle]);
        if (is_new) {
            entry->second = diameter_of_type(file, types, static_cast<std::size_t>(number[particle]));
        }
        const std::optional<double>& of_type = entry->second;
        if (of_type && !stored.empty() && !nearly_equal(*of_type, stored[particle])) {
            file.fail("particle " + std::to_string(particle) + " of frame " + std::to_string(frame) + " has the diameter " +
                      to_text(stored[particle]) + ", but the shape of its " +
                      types.name(static_cast<std::size_t>(number[particle])) + " has " + to_text(*of_type) + "; give --radius");
        }
        diameters[particle] = of_type ? *of_type : stored.empty() ? 1.0 : stored[particle];
    }
    return diameters;
}

}  // namespace coagula::io
