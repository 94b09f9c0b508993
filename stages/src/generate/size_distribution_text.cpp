// SPDX-License-Identifier: GPL-3.0-or-later
#include "size_distribution_text.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/generators/size_distribution.hpp>
#include <coagula/io/table.hpp>
#include <coagula/io/units.hpp>

#include <filesystem>
#include <optional>
#include <system_error>

namespace coagula::stages {

namespace {

using generators::SizeDistribution;
using generators::SizeKind;

SizeDistribution parse_spread(const Arguments& arguments, SizeKind kind, const std::string& text, std::size_t colon) {
    SizeDistribution sizes;
    sizes.kind = kind;
    try {
        sizes.relative_deviation = io::parse_quantity(colon == std::string::npos ? "" : text.substr(colon + 1), "1");
    } catch (const InputError&) {
        throw InputError(arguments.spelled("size-distribution") + ": '" + text +
                         "' needs the standard deviation over the mean, as in " + text.substr(0, colon) + ":0.1");
    }
    return sizes;
}

/// Reads a table of radii [m] and of the share of the particles that has each. The shares may be on any scale.
SizeDistribution read_size_table(const std::string& path) {
    const auto columns =
        io::read_table(path, {{.name = "radius", .unit = "m", .low = physical::length.low, .high = physical::length.high},
                              {.name = "fraction", .unit = "1", .low = 1e-12, .high = 1e12}});
    SizeDistribution sizes;
    sizes.kind = SizeKind::table;
    sizes.table_radius = columns[0];
    sizes.table_fraction = columns[1];
    return sizes;
}

/// @param mean_radius of the particles [m]; a table has its own.
SizeDistribution parse_size_distribution(const Arguments& arguments, std::optional<double> mean_radius) {
    const std::string& text = arguments.text("size-distribution");
    const std::size_t colon = text.find(':');
    const std::string name = text.substr(0, colon);
    SizeDistribution sizes;
    if (name == "normal" || name == "lognormal") {
        sizes = parse_spread(arguments, name == "normal" ? SizeKind::normal : SizeKind::lognormal, text, colon);
    } else if (text != "monodisperse") {
        if (std::error_code ignored; !std::filesystem::exists(text, ignored)) {
            throw InputError("--size-distribution: there is no file '" + text +
                             "'; give monodisperse, normal:S, lognormal:S or a CSV file");
        }
        if (mean_radius) {
            throw InputError(arguments.spelled("radius") + " is not read with " + arguments.spelled("size-distribution", text) +
                             ", which gives the radii itself");
        }
        return read_size_table(text);
    }
    if (!mean_radius) {
        throw InputError(arguments.spelled("radius") + " is missing: it is the mean radius of the particles" + arguments.hint());
    }
    sizes.mean_radius = *mean_radius;
    return sizes;
}

void check_beside_radii(const Arguments& arguments, Index radii) {
    if (arguments.given("particles") && arguments.count("particles") != radii) {
        throw InputError(arguments.spelled("particles") + " is " + std::to_string(arguments.count("particles")) + ", but " +
                         std::to_string(radii) + " radii are given: leave one of the two out");
    }
    for (const char* name : {"radius", "size-distribution"}) {
        if (arguments.given(name)) {
            throw InputError(arguments.spelled(name) + " is not read where the radii of the particles are given");
        }
    }
}

}  // namespace

Eigen::VectorXd radii_of(const Arguments& arguments, const Eigen::VectorXd& given, std::uint64_t seed) {
    if (given.size() > 0) {
        check_beside_radii(arguments, given.size());
        return given;
    }
    return generators::draw_radii(parse_size_distribution(arguments, arguments.optional_quantity("radius")),
                                  arguments.count("particles"), seed);
}

}  // namespace coagula::stages
