// SPDX-License-Identifier: GPL-3.0-or-later
// fit power-law: G' = c (a - a0)^beta through a table of moduli, and what the table says about a0.
#include <coagula/stages/shear.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coagula::stages {

namespace {

using mechanics::PowerLaw;
using mechanics::PowerLawAnalysis;
using mechanics::PowerLawData;
using mechanics::PowerLawFit;
using mechanics::PowerLawMinimum;

std::string name_of_minimum(PowerLawMinimum minimum) {
    switch (minimum) {
        case PowerLawMinimum::far_away:
            return "far_away";
        case PowerLawMinimum::lowest_a:
            return "lowest_a";
        case PowerLawMinimum::inside:
            break;
    }
    return "inside";
}

/// What the data say about a threshold, one sentence.
std::string summary(const PowerLawFit& fit) {
    if (fit.law.beta <= 0) {
        return "the modulus does not rise with a: a0 is not a threshold";
    }
    if (fit.minimum == PowerLawMinimum::far_away) {
        return "the sum of squares falls as far down as a0 was sought: the moduli grow like an exponential, without a threshold";
    }
    if (fit.minimum == PowerLawMinimum::lowest_a) {
        return "the sum of squares falls until a0 reaches the smallest a: the lowest structure stands apart, and it alone sets a0";
    }
    if (fit.bounded_below && fit.bounded_above) {
        return "the structures bound a0 on both sides";
    }
    if (fit.bounded_below || fit.bounded_above) {
        return fit.bounded_below ? "the structures do not bound a0 from above: any value up to the smallest a is possible"
                                 : "the structures do not bound a0 from below: the law may have no threshold at all";
    }
    return "the structures do not bound a0";
}

Json json_number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const PowerLawFit& fit) {
    return {{"a0", json_number(fit.law.a0)},
            {"a0_stderr", json_number(fit.a0_stderr)},
            {"a0_interval", {json_number(fit.a0_low), json_number(fit.a0_high)}},
            {"bounded_below", fit.bounded_below},
            {"bounded_above", fit.bounded_above},
            {"beta", json_number(fit.law.beta)},
            {"beta_stderr", json_number(fit.beta_stderr)},
            {"c", json_number(fit.law.c())},
            {"log_c", json_number(fit.law.log_c)},
            {"log_c_stderr", json_number(fit.log_c_stderr)},
            {"sum_of_squares", json_number(fit.law.sum_of_squares)},
            {"degrees_of_freedom", fit.degrees_of_freedom},
            {"minimum", name_of_minimum(fit.minimum)}};
}

Json list_of(const Eigen::VectorXd& values) {
    return std::vector<double>(values.begin(), values.end());
}

/// One array for each column of the profile.
Json json_of(const mechanics::PowerLawProfile& profile) {
    Json json = {{"a0", Json::array()}, {"beta", Json::array()}, {"log_c", Json::array()}, {"sum_of_squares", Json::array()}};
    for (const PowerLaw& law : profile.laws) {
        json["a0"].push_back(law.a0);
        json["beta"].push_back(law.beta);
        json["log_c"].push_back(law.log_c);
        json["sum_of_squares"].push_back(law.sum_of_squares);
    }
    json["confidence"] = list_of(profile.confidence);
    return json;
}

Json json_of(const PowerLawAnalysis& found, const PowerLawData& data, double confidence) {
    Json json = {{"structures", data.a.size()}, {"weighted", data.standard_error.size() > 0}};
    json.update(json_of(found.fit));
    json["summary"] = summary(found.fit);
    Json without = Json::array();
    for (std::size_t k = 0; k < found.without.size(); ++k) {
        Json entry = {{"structure", k + 1}, {"a", data.a[static_cast<Index>(k)]}};
        entry.update(json_of(found.without[k]));
        without.push_back(std::move(entry));
    }
    json["without"] = std::move(without);
    json["decisive_structure"] = found.decisive < 0 ? Json(nullptr) : Json(found.decisive + 1);
    json["profile"] = json_of(found.profile);
    json["data"] = {{"a", list_of(data.a)}, {"modulus", list_of(data.modulus)}, {"standard_error", list_of(data.standard_error)}};
    json["confidence"] = confidence;
    check_finite(json);
    return json;
}

std::string with_error(double value, double error) {
    return with_unit(value, "1") + (std::isfinite(error) ? " +- " + with_unit(error, "1") : "");
}

/// @param smallest_a of the structures that were fitted; five digits may not tell it from the upper end.
std::string interval(const PowerLawFit& fit, double smallest_a) {
    const std::string low = fit.bounded_below ? with_unit(fit.a0_low, "1") : "unbounded";
    const std::string high = with_unit(fit.a0_high, "1");
    if (!fit.bounded_above) {
        return low + " .. " + high + " (the smallest a)";
    }
    const bool told_apart = high != with_unit(smallest_a, "1");
    return low + " .. " + high + (told_apart ? "" : " (" + with_unit(smallest_a - fit.a0_high, "1") + " below the smallest a)");
}

double smallest_a_without(const PowerLawData& data, std::size_t left_out) {
    double smallest = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < data.a.size(); ++k) {
        smallest = static_cast<std::size_t>(k) == left_out ? smallest : std::min(smallest, data.a[k]);
    }
    return smallest;
}

Table table_of(const PowerLawAnalysis& found, const PowerLawData& data, double confidence) {
    const PowerLawFit& fit = found.fit;
    const std::string percent = with_unit(100 * confidence, "1") + " %";
    const bool weighted = data.standard_error.size() > 0;
    Table table{{"structures", std::to_string(data.a.size()) + (weighted ? ", weighted by their standard errors" : "")},
                {"critical value a0", with_error(fit.law.a0, fit.a0_stderr)},
                {"  " + percent + " interval", interval(fit, data.a.minCoeff())},
                {"exponent beta", with_error(fit.law.beta, fit.beta_stderr)},
                {"factor c", with_unit(fit.law.c(), "Pa")},
                {"sum of squares", with_unit(fit.law.sum_of_squares, weighted ? "1" : "Pa2") + " with " +
                                       std::to_string(fit.degrees_of_freedom) + " degrees of freedom"},
                {"", summary(fit)}};
    for (std::size_t k = 0; k < found.without.size(); ++k) {
        const PowerLawFit& rest = found.without[k];
        if (!std::isfinite(rest.law.a0)) {
            continue;
        }
        const bool decisive = static_cast<Index>(k) == found.decisive;
        table.emplace_back("without a = " + with_unit(data.a[static_cast<Index>(k)], "1"),
                           "a0 " + with_unit(rest.law.a0, "1") + ", " + percent + " interval " +
                               interval(rest, smallest_a_without(data, k)) + ", beta " + with_unit(rest.law.beta, "1") +
                               (decisive ? "   <- moves a0 most" : ""));
    }
    return table;
}

std::vector<std::vector<std::string>> rows_of(const mechanics::PowerLawProfile& profile, const std::string& unit) {
    std::vector<std::vector<std::string>> rows{{"a0", "beta", "log_c", "sum_of_squares [" + unit + "]", "confidence"}};
    for (std::size_t k = 0; k < profile.laws.size(); ++k) {
        const PowerLaw& law = profile.laws[k];
        rows.push_back({to_text(law.a0), to_text(law.beta), to_text(law.log_c), to_text(law.sum_of_squares),
                        profile.confidence.size() > 0 ? to_text(profile.confidence[static_cast<Index>(k)]) : ""});
    }
    return rows;
}

}  // namespace

mechanics::PowerLawOptions power_law_options(const Arguments& arguments) {
    return {.confidence = arguments.quantity("confidence"), .points = arguments.count("points")};
}

FittedPowerLaw fit_power_law(const mechanics::PowerLawOptions& options, const PowerLawData& data, const Progress& progress) {
    const PowerLawAnalysis found = mechanics::fit_power_law(data, options, progress);
    const std::string unit = data.standard_error.size() > 0 ? "1" : "Pa2";
    return {{json_of(found, data, options.confidence), table_of(found, data, options.confidence)}, rows_of(found.profile, unit)};
}

Verb fit_power_law_verb() {
    return {.name = "fit power-law",
            .summary = "G' = c (a - a0)^beta through a table of moduli, with the profile of a0",
            .input = "TABLE.csv",
            .options = {text("a", "NAME", "column of the degree of heterogeneity", "a"),
                        text("modulus", "NAME", "column of the shear modulus, its unit in the header: modulus [MPa]", "modulus"),
                        text("standard-error", "NAME",
                             "column of the standard error of the modulus; standard_error, if there is one, when not given"),
                        quantity("modulus-unit", "Pa", "unit of the moduli where the header names none", "", physical::modulus),
                        quantity("confidence", "1", "confidence level of the interval of a0", "0.95", within(1e-6, 0.999999)),
                        count("points", "number of points of the profile", "300", within(10, 10000)),
                        output("write the profile as CSV"), flag("force", "replace an existing output file")},
            .notes = {"Least squares in the modulus; with standard errors weighted, which are then taken as they are."}};
}

}  // namespace coagula::stages
