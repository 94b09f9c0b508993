// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate: shear modulus against the stiffness of the particles, and the stiffness that matches measured moduli.
#include "rheometer_run.hpp"

#include <coagula/characterize/inner_particles.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace coagula::stages {

namespace {

using mechanics::StiffnessCalibration;
using mechanics::StiffnessSeries;
using Moduli = std::optional<Eigen::VectorXd>;

struct Structures {
    std::vector<std::string> files;
    std::vector<StiffnessSeries> series;

    std::size_t size() const { return files.size(); }
    const Eigen::VectorXd& normal_stiffness() const { return series.front().normal_stiffness; }
    const Eigen::VectorXd& shear_stiffness() const { return series.front().shear_stiffness; }
    /// Modulus over that of the first structure; nothing when that carries no load.
    Moduli ratio(std::size_t k) const {
        const StiffnessSeries& first = series.front();
        return first.carries_shear ? Moduli(series[k].modulus.cwiseQuotient(first.modulus)) : std::nullopt;
    }
};

mechanics::StiffnessSeriesOptions series_options(const Arguments& arguments) {
    const double from = arguments.quantity("from");
    const double to = arguments.quantity("to");
    if (!(from < to)) {
        throw InputError(arguments.spelled("from") + " is " + to_text(from) + " N/m and " + arguments.spelled("to") + " " +
                         to_text(to) + " N/m: the series must run upwards");
    }
    mechanics::StiffnessSeriesOptions options;
    options.normal_stiffness = Eigen::VectorXd::LinSpaced(arguments.count("steps"), from, to);
    options.stiffness_ratio = arguments.quantity("stiffness-ratio");
    const std::string& method = arguments.text("method");
    if (method == "dem") {
        options.method = mechanics::SeriesMethod::dem;
        options.rheometer = rheometer_options_of(arguments, {}, {});
    } else if (method == "quasistatic") {
        options.method = mechanics::SeriesMethod::quasistatic;
        options.quasistatic.rest_length =
            arguments.text("rest-length") == "found" ? mechanics::RestLength::as_found : mechanics::RestLength::touching;
    }
    return options;
}

/// "1.5MPa,480kPa": one modulus for each structure.
Moduli measured_moduli(const Arguments& arguments, std::size_t structures) {
    if (!arguments.has("measured")) {
        return std::nullopt;
    }
    const std::vector<std::string> words = split(arguments.text("measured"));
    if (words.size() != structures) {
        throw InputError(arguments.spelled("measured") + " has " + std::to_string(words.size()) + " moduli for " +
                         std::to_string(structures) + " structures: each structure needs one");
    }
    Eigen::VectorXd moduli(static_cast<Index>(words.size()));
    try {
        std::transform(words.begin(), words.end(), moduli.begin(),
                       [](const std::string& word) { return parse_quantity(word, "Pa", physical::modulus); });
    } catch (const InputError& error) {
        throw InputError(arguments.spelled("measured") + ": " + error.what());
    }
    return moduli;
}

StiffnessSeries series_of(const Packing& packing, double bond_tolerance, mechanics::StiffnessSeriesOptions options,
                          const Progress& progress) {
    if (!packing.cell.is_periodic()) {
        const characterize::FreeSurface surface = characterize::free_surface(packing);
        options.linear.held = surface.outer;
        options.linear.volume = surface.inner_volume;
    }
    return mechanics::measure_stiffness_series(packing, find_contacts(packing, bond_tolerance), options, progress);
}

Structures measure_all(const CalibrationRun& run, const std::vector<std::string>& names, const std::vector<Packing>& packings,
                       const Progress& progress) {
    Structures structures{.files = names, .series = {}};
    for (const Packing& packing : packings) {
        structures.series.push_back(series_of(packing, run.bond_tolerance, run.series, progress));
    }
    return structures;
}

std::optional<StiffnessCalibration> matching(const Structures& structures, const Moduli& measured) {
    if (!measured) {
        return std::nullopt;
    }
    Eigen::VectorXd slope(measured->size());
    for (std::size_t k = 0; k < structures.size(); ++k) {
        if (!structures.series[k].carries_shear) {
            throw InputError(structures.files[k] +
                             " carries no shear: its modulus is zero at every stiffness, none matches the measured ones");
        }
        slope[static_cast<Index>(k)] = structures.series[k].line_through_origin.slope;
    }
    return mechanics::calibrate_stiffness(slope, *measured);
}

Json json_of(const Eigen::VectorXd& values) {
    return std::vector<double>(values.begin(), values.end());
}

/// What is unset becomes null.
Json json_of(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const mechanics::StraightLine& line) {
    return {{"slope", json_of(line.slope)},
            {"intercept", json_of(line.intercept)},
            {"slope_stderr", json_of(line.slope_stderr)},
            {"intercept_stderr", json_of(line.intercept_stderr)},
            {"rms_residual", json_of(line.rms_residual)}};
}

Json json_of(const Structures& structures) {
    Json list = Json::array();
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StiffnessSeries& series = structures.series[k];
        const Moduli ratio = structures.ratio(k);
        list.push_back({{"file", structures.files[k]},
                        {"contacts", series.contacts},
                        {"rattlers", series.rattlers},
                        {"storage_modulus", {{"mean", json_of(series.modulus)}, {"std", json_of(series.modulus_deviation)}}},
                        {"line", json_of(series.line)},
                        {"line_through_origin", json_of(series.line_through_origin)},
                        {"ratio_to_first", ratio ? json_of(*ratio) : Json(nullptr)}});
    }
    return list;
}

Json json_of(const StiffnessCalibration& found, const Eigen::VectorXd& measured) {
    return {{"measured_modulus", json_of(measured)},
            {"matching_normal_stiffness", json_of(found.matching)},
            {"common",
             {{"normal_stiffness", json_of(found.common)},
              {"stderr", json_of(found.common_stderr)},
              {"storage_modulus", json_of(found.modulus_at_common)},
              {"relative_difference", json_of(found.difference_at_common)}}}};
}

Json json_of(const CalibrationRun& run, const Structures& structures, const std::optional<StiffnessCalibration>& found) {
    Json json = {{"method", run.method},
                 {"bond_tolerance", run.bond_tolerance},
                 {"stiffness_ratio", run.series.stiffness_ratio},
                 {"normal_stiffness", json_of(structures.normal_stiffness())},
                 {"shear_stiffness", json_of(structures.shear_stiffness())},
                 {"structures", json_of(structures)}};
    if (found) {
        json["calibration"] = json_of(*found, *run.measured);
    }
    check_finite(json);
    return json;
}

/// What rounding leaves of moduli of this size is nothing.
double beyond_rounding(double modulus, double size) {
    constexpr double rounding = 1e-12;
    return std::abs(modulus) > rounding * size ? modulus : 0.0;
}

void append_series(Table& table, const Structures& structures) {
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StiffnessSeries& series = structures.series[k];
        table.emplace_back("structure " + std::to_string(k + 1), structures.files[k] + ", " + std::to_string(series.contacts) +
                                                                     " bonds, " + std::to_string(series.rattlers) + " rattlers");
    }
    table.emplace_back("", "+- is the standard deviation over the six orientations of one structure");
    for (Index step = 0; step < structures.normal_stiffness().size(); ++step) {
        std::string moduli, ratios;
        for (std::size_t k = 0; k < structures.size(); ++k) {
            moduli += (k > 0 ? ", " : "") + with_unit(structures.series[k].modulus[step], "Pa") + " +- " +
                      with_unit(structures.series[k].modulus_deviation[step], "Pa");
            const Moduli ratio = structures.ratio(k);
            ratios += k > 0 && ratio ? " : " + with_unit((*ratio)[step], "1") : "";
        }
        table.emplace_back("G' at " + with_unit(structures.normal_stiffness()[step], "N/m"),
                           moduli + (ratios.empty() ? "" : "; ratio 1" + ratios));
    }
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StiffnessSeries& series = structures.series[k];
        table.emplace_back("line of structure " + std::to_string(k + 1),
                           with_unit(series.line.slope, "1") + " Pa/(N/m), at zero stiffness " +
                               with_unit(beyond_rounding(series.line.intercept, series.modulus.maxCoeff()), "Pa") +
                               "; through the origin " + with_unit(series.line_through_origin.slope, "1") + " Pa/(N/m)");
    }
}

void append_calibration(Table& table, const Structures& structures, const StiffnessCalibration& found,
                        const Eigen::VectorXd& measured) {
    const Eigen::VectorXd& stiffness = structures.normal_stiffness();
    const auto described = [&stiffness](double value) {
        const bool beyond = value < stiffness.minCoeff() || value > stiffness.maxCoeff();
        return with_unit(value, "N/m") + (beyond ? " (outside the series)" : "");
    };
    std::string differences;
    for (Index k = 0; k < measured.size(); ++k) {
        table.emplace_back("matches " + with_unit(measured[k], "Pa"),
                           "structure " + std::to_string(k + 1) + " at " + described(found.matching[k]));
        differences += (k > 0 ? ", " : "") + with_unit(100 * found.difference_at_common[k], "1") + " %";
    }
    if (measured.size() > 1) {
        table.emplace_back("matches all best", described(found.common) + " +- " + with_unit(found.common_stderr, "N/m") +
                                                   ", simulated less measured " + differences);
    }
}

/// One row per structure and stiffness.
std::vector<std::vector<std::string>> rows_of(const Structures& structures) {
    std::vector<std::vector<std::string>> rows{{"structure", "normal stiffness [N/m]", "shear stiffness [N/m]", "modulus [Pa]",
                                                "standard deviation [Pa]", "ratio to first"}};
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const StiffnessSeries& series = structures.series[k];
        const Moduli ratio = structures.ratio(k);
        for (Index step = 0; step < series.modulus.size(); ++step) {
            rows.push_back({structures.files[k], to_text(series.normal_stiffness[step]), to_text(series.shear_stiffness[step]),
                            to_text(series.modulus[step]), to_text(series.modulus_deviation[step]),
                            ratio ? to_text((*ratio)[step]) : ""});
        }
    }
    return rows;
}

}  // namespace

CalibrationRun calibration_run(const Arguments& arguments, std::size_t structures) {
    return {.series = series_options(arguments),
            .method = arguments.text("method"),
            .bond_tolerance = arguments.quantity("bond-tolerance"),
            .measured = measured_moduli(arguments, structures)};
}

Calibrated calibrate(const CalibrationRun& run, const std::vector<std::string>& names, const std::vector<Packing>& packings,
                     const Progress& progress) {
    const Structures structures = measure_all(run, names, packings, progress);
    const auto found = matching(structures, run.measured);
    Table table;
    append_series(table, structures);
    if (found) {
        append_calibration(table, structures, *found, *run.measured);
    }
    return {{json_of(run, structures, found), std::move(table)}, rows_of(structures)};
}

Verb calibrate_verb() {
    Verb verb{
        .name = "calibrate",
        .summary = "shear modulus against particle stiffness; the stiffness that matches measured moduli",
        .input = "FILE.h5 ...",
        .options = {choice("method", {"linear", "quasistatic", "dem"}, "how each modulus is found, as coagula shear does",
                           "linear"),
                    quantity("from", "N/m", "smallest normal stiffness of a particle", "50N/m", physical::stiffness),
                    quantity("to", "N/m", "largest normal stiffness of a particle", "150N/m", physical::stiffness),
                    count("steps", "number of stiffnesses, equally spaced", "5", within(2, 1000)),
                    quantity("stiffness-ratio", "1", "normal over shear stiffness, the same for all", "10", within(1e-6, 1e6)),
                    quantity("bond-tolerance", "1", "pairs nearer than (1 + X) (r_i + r_j) are bonded", "0.01", within(0, 1)),
                    text("measured", "LIST", "measured shear modulus of each structure, such as 1.5MPa,480kPa"),
                    output("write the table as CSV"), flag("force", "replace an existing output file")},
        .notes =
            {"Ratios are relative to the first structure. For the ratio of Schenker et al. 2012 give the most homogeneous one "
             "first.",
             "With linear springs in a fixed ratio the modulus is proportional to the stiffness; the table shows how exactly."},
        .many_inputs = true};
    for (const Option& option : rheometer_options()) {
        if (option.name != "orientation" && option.name != "checkpoint") {
            verb.options.insert(verb.options.end() - 2, option);
        }
    }
    return verb;
}

}  // namespace coagula::stages
