// SPDX-License-Identifier: GPL-3.0-or-later
// One place per structure: its modulus, heterogeneity, coordination or volume fraction.
#include "figure_parts.hpp"

#include <coagula/io/table.hpp>
#include <coagula/mechanics/power_law.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

const std::string characterization = "/characterization/";

struct Method {
    std::string group;
    std::string words;
};
const std::array<Method, 3> methods{{{"/mechanics/linear/", "linear response of the bonded network"},
                                     {"/mechanics/quasistatic/", "quasi-static equilibria"},
                                     {"/mechanics/dem/", "explicit discrete elements"}}};

/// The first method that gave every structure one modulus; the linear one when there is none, whose absence is told then.
const Method& common_method(const Sources& sources) {
    const auto has_all = [&](const Method& method) {
        return std::all_of(sources.begin(), sources.end(), [&](const FigureSource& source) {
            const io::Dataset* modulus = source.contents ? source.find(method.group + "storage_modulus/mean") : nullptr;
            return !source.contents || (modulus != nullptr && modulus->shape.empty());
        });
    };
    const auto found = std::find_if(methods.begin(), methods.end(), has_all);
    return found == methods.end() ? methods.front() : *found;
}

/// The legend entry that a structure shares with others: its label, or how it was made.
std::string kind_of(const FigureSource& source) {
    if (source.labelled || !source.contents || source.contents->history.empty()) {
        return source.label;
    }
    const std::string& stage = source.contents->history.front().stage;
    return stage == "generate vem" ? "VEM" : stage == "generate brownian" ? "BD" : source.label;
}

struct Place {
    double x = unset;
    double y = unset;
    double error = unset;
};

/// One series per kind, in the order in which the kinds appear.
template <class PlaceOf>
std::vector<Series> scattered(const Sources& sources, const PlaceOf& place_of) {
    std::vector<Series> series;
    for (const FigureSource& source : sources) {
        const std::string kind = kind_of(source);
        auto found = std::find_if(series.begin(), series.end(), [&](const Series& one) { return one.name == kind; });
        if (found == series.end()) {
            const int colour = kind == "VEM" ? 0 : kind == "BD" ? 1 : static_cast<int>(series.size()) + 2;
            found = series.insert(found, {.name = kind, .mark = Mark::points, .colour = colour, .per_structure = true});
        }
        const Place place = place_of(source);
        found->x.push_back(place.x);
        found->y.push_back(place.y);
        if (std::isfinite(place.error)) {
            found->error.push_back(place.error);
        }
    }
    return series;
}

/// Structures and rows of tables, as power-law data; the tables have a series each.
struct ModuliOverHeterogeneity {
    std::vector<Series> series;
    mechanics::PowerLawData data;
    std::string method;
};

Series series_of_table(const FigureSource& source, int colour) {
    const std::vector<Eigen::VectorXd> columns =
        io::read_table(source.file, {{.name = "a", .unit = "1"},
                                     {.name = "modulus", .unit = "Pa"},
                                     {.name = "standard_error", .unit = "Pa", .required = false}});
    return {.name = source.label,
            .x = {columns[0].begin(), columns[0].end()},
            .y = {columns[1].begin(), columns[1].end()},
            .error = {columns[2].begin(), columns[2].end()},
            .mark = Mark::points,
            .colour = colour,
            .per_structure = true};
}

ModuliOverHeterogeneity moduli_over_heterogeneity(const Sources& sources) {
    ModuliOverHeterogeneity found;
    const Method& method = common_method(sources);
    Sources structures;
    int tables = 0;
    for (const FigureSource& source : sources) {
        if (source.contents) {
            structures.push_back(source);
        } else {
            found.series.push_back(series_of_table(source, 2 + tables++));
        }
    }
    for (Series& series : scattered(structures, [&](const FigureSource& source) {
             return Place{source.number(characterization + "doh/a"), source.number(method.group + "storage_modulus/mean"),
                          source.number(method.group + "storage_modulus/std")};
         })) {
        found.series.push_back(std::move(series));
    }
    found.method = structures.empty() ? "" : "; simulated by " + method.words;
    std::vector<double> a, modulus, error;
    bool all_weighted = structures.empty();
    for (const Series& series : found.series) {
        a.insert(a.end(), series.x.begin(), series.x.end());
        modulus.insert(modulus.end(), series.y.begin(), series.y.end());
        error.insert(error.end(), series.error.begin(), series.error.end());
        all_weighted = all_weighted && series.error.size() == series.y.size();
    }
    const auto vector_of = [](const std::vector<double>& values) -> Eigen::VectorXd {
        return Eigen::VectorXd::Map(values.data(), static_cast<Index>(values.size()));
    };
    found.data = {vector_of(a), vector_of(modulus), all_weighted ? vector_of(error) : Eigen::VectorXd()};
    return found;
}

/// Throws InputError with what the fit wants.
mechanics::PowerLawAnalysis fitted(const mechanics::PowerLawData& data) {
    try {
        return mechanics::fit_power_law(data, {.leave_one_out = false});
    } catch (const std::invalid_argument& error) {
        throw InputError(std::string("no power law goes through these moduli: ") + error.what());
    }
}

/// The law from near a0 on, in equal steps of ln(a - a0), for it is steep there.
Series line_of_law(const mechanics::PowerLaw& law, double largest_a) {
    constexpr int steps = 200;
    Series line{.name = "fit", .mark = Mark::line, .colour = -1};
    const double reach = largest_a - law.a0;
    for (int k = 0; k <= steps; ++k) {
        const double distance = reach * std::exp(-14.0 * (1 - static_cast<double>(k) / steps));
        line.x.push_back(law.a0 + distance);
        line.y.push_back(law.modulus(law.a0 + distance));
    }
    return line;
}

constexpr Index fewest_for_fit = 4;

}  // namespace

ChartAxis heterogeneity_axis() {
    return {.name = "degree of heterogeneity {/:Italic a}", .plain = "degree of heterogeneity"};
}

ChartAxis modulus_axis_of(const std::string& name, const std::string& plain) {
    return {.name = name, .plain = plain, .unit = "Pa", .from_zero = true};
}

Drawing draw_modulus_volume_fraction(const Sources& sources) {
    const Method& method = common_method(sources);
    const auto place = [&](const FigureSource& source) {
        return Place{source.number(characterization + "volume_fraction"), source.number(method.group + "storage_modulus/mean"),
                     source.number(method.group + "storage_modulus/std")};
    };
    std::vector<Series> series = scattered(sources, place);
    const Chart chart{.x = {.name = "volume fraction {/Symbol F}", .plain = "volume fraction"},
                      .y = modulus_axis_of("shear modulus {/:Italic G}′", "shear modulus"),
                      .series = std::move(series),
                      .legend = Legend::top_left};
    return {.panels = {chart},
            .caption = "Shear modulus G' against the volume fraction, simulated by " + method.words +
                       ". The bars are the standard deviation over the orientations of one structure."};
}

Drawing draw_heterogeneity_coordination(const Sources& sources) {
    const auto place = [](const FigureSource& source) {
        return Place{source.number(characterization + "coordination"), source.number(characterization + "doh/a"),
                     source.number(characterization + "doh/a_stderr")};
    };
    std::vector<Series> series = scattered(sources, place);
    const Chart chart{.x = {.name = "coordination number {/:Italic C}", .plain = "coordination number"},
                      .y = heterogeneity_axis(),
                      .series = std::move(series)};
    return {.panels = {chart},
            .caption =
                "Degree of heterogeneity, as measured by the parameter a, against the coordination number C. The bars are the "
                "standard error of the fit of a."};
}

Drawing draw_modulus_heterogeneity(const Sources& sources) {
    ModuliOverHeterogeneity found = moduli_over_heterogeneity(sources);
    Chart chart{.x = heterogeneity_axis(),
                .y = modulus_axis_of("shear modulus {/:Italic G}′", "shear modulus"),
                .series = found.series,
                .legend = Legend::bottom_right};
    std::string fit = ". Fewer than " + std::to_string(fewest_for_fit) + " structures: no power law is fitted";
    if (found.data.a.size() >= fewest_for_fit) {
        const mechanics::PowerLawAnalysis analysis = fitted(found.data);
        const mechanics::PowerLaw& law = analysis.fit.law;
        const double span = found.data.a.maxCoeff() - found.data.a.minCoeff();
        const bool threshold = law.a0 > found.data.a.minCoeff() - span;
        chart.series.push_back(line_of_law(law, found.data.a.maxCoeff()));
        if (threshold) {
            chart.series.push_back(
                {.x = {law.a0, law.a0}, .y = {0, found.data.modulus.maxCoeff()}, .mark = Mark::dashed_line, .colour = -1});
        } else {
            chart.x.low = found.data.a.minCoeff() - 0.1 * span;
        }
        fit = ". Solid: power law c (a − a0)^β by least squares, a0 = " + with_digits(law.a0, 3) +
              ", β = " + with_digits(law.beta, 3) + std::string(threshold ? "; dashed: a0" : "");
    }
    return {.panels = {chart},
            .caption = "Shear modulus G' against the degree of heterogeneity a" + found.method + fit +
                       ". The bars are the standard deviation over the orientations of one structure, or the standard error that a "
                       "table gives."};
}

Drawing draw_critical_value(const Sources& sources) {
    const ModuliOverHeterogeneity found = moduli_over_heterogeneity(sources);
    const mechanics::PowerLawAnalysis analysis = fitted(found.data);
    if (analysis.profile.confidence.size() == 0) {
        throw InputError("the critical value has no profile: three moduli without standard errors leave nothing to judge it by");
    }
    Series profile{.name = "", .mark = Mark::line, .colour = 0};
    for (std::size_t k = 0; k < analysis.profile.laws.size(); ++k) {
        profile.x.push_back(analysis.profile.laws[k].a0);
        profile.y.push_back(analysis.profile.confidence[static_cast<Index>(k)]);
    }
    const double smallest = found.data.a.minCoeff();
    const double span = found.data.a.maxCoeff() - smallest;
    const double low = analysis.fit.bounded_below ? smallest - 2.5 * (smallest - analysis.fit.a0_low) : smallest - span;
    const Chart chart{
        .x = {.name = "critical value {/:Italic a}_0", .plain = "critical value a0", .low = low, .high = smallest},
        .y = {.name = "confidence of exclusion", .plain = "confidence of exclusion", .low = 0, .high = 1.02},
        .series = {profile, {.name = "95 %", .x = {low, smallest}, .y = {0.95, 0.95}, .mark = Mark::dashed_line, .colour = 1}},
        .legend = Legend::bottom_left};
    return {.panels = {chart},
            .caption =
                "Confidence at which each critical value a0 of the power law is excluded by the moduli. The part below the dashed "
                "line is the 95 % confidence interval."};
}

std::vector<Series> published_heterogeneity_coordination() {
    return published_series([](const PublishedStructure& row) { return row.coordination; },
                            [](const PublishedStructure& row) { return row.a; }, nullptr);
}

std::vector<Series> published_modulus_heterogeneity() {
    return published_series([](const PublishedStructure& row) { return row.a; },
                            [](const PublishedStructure& row) { return row.modulus; },
                            [](const PublishedStructure& row) { return row.spread; });
}

}  // namespace coagula::report
