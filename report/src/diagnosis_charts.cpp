// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnosis_charts.hpp"

#include "html.hpp"
#include "page_axis.hpp"

#include <coagula/diagnose/observable.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace coagula::report {

namespace {

using diagnose::Diagnosis;
using diagnose::find_observable;
using diagnose::Measurement;
using diagnose::Observable;
using diagnose::observable_named;
using diagnose::PredictedRow;

/// Observables that share a figure: an elastic and a viscous one, those near the plane and along z, or one alone.
struct Pair {
    std::array<const Observable*, 2> observables;  ///< the second is null where one is alone
    std::string name;                              ///< of both, in a sentence; empty: each has its own
    std::string title;
    std::string label;  ///< of the axis; empty: it follows from the values
    std::string size;   ///< what errors of predictions are measured against
    double unit = 1;

    bool is(std::size_t part, const std::string& key) const {
        return observables.at(part) != nullptr && observables.at(part)->key == key;
    }
    bool has(const std::string& key) const { return is(0, key) || is(1, key); }
    std::string symbol(std::size_t part) const {
        return observables.at(part) == nullptr ? "" : std::string(observables.at(part)->symbol);
    }
    bool of_moduli() const { return observables.front()->unit == "Pa"; }
    /// Moduli and viscosities of samples differ by factors.
    bool scales() const { return of_moduli() || observables.front()->unit == "Pa.s"; }
};

const std::array<Pair, 5>& pairs() {
    const auto both = [](std::string_view first, std::string_view second) {
        return std::array{&observable_named(first), find_observable(second)};
    };
    static const std::array<Pair, 5> all{{
        {both("storage_modulus", "loss_modulus"), "", "Moduli", "", "|G*|"},
        {both("third_harmonic_storage", "third_harmonic_loss"), "the third harmonic", "Third harmonic of the stress",
         "third over first harmonic [%]", "|G*|", 0.01},
        {both("neighbours_plane", "neighbours_axis"), "the neighbours", "Neighbours in shells of distance", "neighbours in a shell",
         "one neighbour"},
        {both("exclusion_probability", ""), "the pores", "Pores", "share of the void space farther away", "the void space"},
        {both("viscosity", ""), "the viscosity", "Viscosity in steady flow", "", "the viscosity"},
    }};
    return all;
}

/// The rows of one table that belong to a pair, with the place of each along the axis.
struct Shown {
    const Pair& pair;
    PageAxis x;
    std::vector<std::size_t> rows = {};  ///< of Diagnosis::rows
    std::vector<double> places = {};     ///< in the unit of the axis
};

Shown rows_of(const Measurement& table, std::size_t number, const Diagnosis& diagnosis, const Pair& pair) {
    const diagnose::Column* column = diagnose::axis_of(table);
    const std::string own_axis(pair.observables.front()->axis);
    Shown shown{.pair = pair, .x = axis_named(!own_axis.empty() ? own_axis : column == nullptr ? "" : column->name)};
    for (std::size_t k = 0; k < diagnosis.rows.size(); ++k) {
        const PredictedRow& row = diagnosis.rows[k];
        if (row.measurement == number && pair.has(row.observable)) {
            const double place = !own_axis.empty()   ? row.distance
                                 : column == nullptr ? static_cast<double>(row.row + 1)
                                                     : column->values[row.row];
            shown.x.include(place);
            shown.rows.push_back(k);
            shown.places.push_back(place / shown.x.unit);
        }
    }
    return shown;
}

PageAxis value_axis(const Shown& shown, const Diagnosis& diagnosis) {
    double largest = 0;
    for (const std::size_t k : shown.rows) {
        largest = std::max(largest, diagnosis.rows[k].measured);
    }
    PageAxis y = shown.pair.of_moduli() ? modulus_axis(largest)
                 : shown.pair.scales()  ? viscosity_axis(largest)
                                        : PageAxis{.label = shown.pair.label, .unit = shown.pair.unit};
    for (const std::size_t k : shown.rows) {
        const PredictedRow& row = diagnosis.rows[k];
        for (const double value : {row.measured, row.base_fitted}) {
            if (!shown.pair.scales() || value > 0) {
                y.include(value);
            }
        }
    }
    return y;
}

/// One number of each row of one observable, by its place.
template <class Value>
Json curve(const Shown& shown, const Diagnosis& diagnosis, std::size_t part, const Value& value) {
    Json x = Json::array();
    Json y = Json::array();
    for (std::size_t k = 0; k < shown.rows.size(); ++k) {
        if (shown.pair.is(part, diagnosis.rows[shown.rows[k]].observable)) {
            x.push_back(shown.places[k]);
            y.push_back(finite_or_null(value(shown.rows[k])));
        }
    }
    return {{"x", std::move(x)}, {"y", std::move(y)}};
}

Json joined(Json first, const Json& second) {
    first.update(second);
    return first;
}

bool has(const Shown& shown, const Diagnosis& diagnosis, std::size_t part) {
    return std::any_of(shown.rows.begin(), shown.rows.end(),
                       [&](std::size_t k) { return shown.pair.is(part, diagnosis.rows[k].observable); });
}

/// What the points of both observables have in common.
Json points(const Shown& shown, const Diagnosis& diagnosis, std::size_t part) {
    Json json = curve(shown, diagnosis, part, [&](std::size_t k) { return diagnosis.rows[k].held_out ? 1.0 : 0.0; });
    Json open = Json::array();
    for (const Json& held : json["y"]) {
        open.push_back(held == 1.0);
    }
    return {{"kind", "points"}, {"shape", part == 0 ? "circle" : "triangle"}, {"open", std::move(open)}};
}

/// Lines of the models as fitted below, what was measured above.
Json data_chart(const Shown& shown, const Diagnosis& diagnosis, const std::string& cause) {
    static constexpr std::array colours = {"--third", "--fourth", "--fifth", "--sixth"};
    const PageAxis y = value_axis(shown, diagnosis);
    Json series = Json::array();
    for (std::size_t part = 0; part < 2; ++part) {
        if (!has(shown, diagnosis, part)) {
            continue;
        }
        const auto line = [&](const std::string& name, const std::string& colour, const auto& value) {
            return joined({{"name", name}, {"kind", "line"}, {"colour", colour}},
                          curve(shown, diagnosis, part, [&](std::size_t k) { return value(k) / y.unit; }));
        };
        series.push_back(
            joined(line("base model", "--base", [&](std::size_t k) { return diagnosis.rows[k].base_fitted; }), {{"dashed", true}}));
        if (!cause.empty()) {
            series.push_back(line("with " + cause, "--extended", [&](std::size_t k) { return diagnosis.rows[k].extended_fitted; }));
        }
        for (std::size_t other = 0; other < diagnosis.others.size(); ++other) {
            const diagnose::OtherPrediction& prediction = diagnosis.others[other];
            series.push_back(joined(line("with " + name_of(prediction.cause), colours.at(other % colours.size()),
                                         [&](std::size_t k) { return prediction.fitted[k]; }),
                                    {{"hidden", true}}));
        }
    }
    for (std::size_t part = 0; part < 2; ++part) {
        if (has(shown, diagnosis, part)) {
            const auto of = [&](double PredictedRow::*value) {
                return curve(shown, diagnosis, part, [&](std::size_t k) { return diagnosis.rows[k].*value / y.unit; });
            };
            series.push_back(joined(
                joined(points(shown, diagnosis, part), of(&PredictedRow::measured)),
                {{"name", shown.pair.symbol(part)}, {"colour", "--ink"}, {"error", of(&PredictedRow::standard_deviation)["y"]}}));
        }
    }
    return {{"title", shown.pair.title}, {"x", shown.x.json()}, {"y", y.json()}, {"series", std::move(series)}, {"height", 360}};
}

Json residual_chart(const Shown& shown, const Diagnosis& diagnosis, const std::string& cause) {
    Json series = Json::array();
    for (std::size_t part = 0; part < 2; ++part) {
        if (!has(shown, diagnosis, part)) {
            continue;
        }
        const auto add = [&](const std::string& name, const std::string& colour, double PredictedRow::*residual) {
            series.push_back(
                joined(joined(points(shown, diagnosis, part),
                              curve(shown, diagnosis, part, [&](std::size_t k) { return diagnosis.rows[k].*residual; })),
                       {{"name", name}, {"colour", colour}}));
        };
        add("base model", "--base", &PredictedRow::base_residual);
        if (!cause.empty()) {
            add("with " + cause, "--extended", &PredictedRow::extended_residual);
        }
    }
    return {{"title", "What remains"},
            {"x", shown.x.json()},
            {"y", {{"label", "residual [standard deviations]"}}},
            {"band", {-2, 2}},
            {"zero", true},
            {"series", std::move(series)},
            {"height", 360}};
}

/// Error of a prediction over the level of its row: |G*| of moduli, 1 of all else.
double level_of(const Shown& shown, const Diagnosis& diagnosis, std::size_t row) {
    double square = 0;
    for (const std::size_t k : shown.rows) {
        square += diagnosis.rows[k].row == diagnosis.rows[row].row ? std::pow(diagnosis.rows[k].measured, 2) : 0;
    }
    return shown.pair.of_moduli() ? std::sqrt(square) : 1.0;
}

Json gain_series(const Shown& shown, const Diagnosis& diagnosis, const std::string& name, const std::string& colour,
                 double diagnose::HeldOutPrediction::*model) {
    Json list = Json::array();
    for (std::size_t part = 0; part < 2; ++part) {
        Json x = Json::array();
        Json y = Json::array();
        for (const diagnose::HeldOutPrediction& held : diagnosis.gain.predictions) {
            const auto found = std::find(shown.rows.begin(), shown.rows.end(), held.row);
            const PredictedRow& row = diagnosis.rows.at(held.row);
            if (found != shown.rows.end() && shown.pair.is(part, row.observable)) {
                x.push_back(shown.places[static_cast<std::size_t>(found - shown.rows.begin())]);
                y.push_back(finite_or_null(100 * (held.*model - row.measured) / level_of(shown, diagnosis, held.row)));
            }
        }
        if (!x.empty()) {
            list.push_back({{"name", name}, {"kind", "line"}, {"colour", colour}, {"x", x}, {"y", y}, {"width", 1.4}});
            list.push_back({{"name", name},
                            {"kind", "points"},
                            {"colour", colour},
                            {"shape", part == 0 ? "circle" : "triangle"},
                            {"x", x},
                            {"y", y}});
        }
    }
    return list;
}

}  // namespace

std::string Charts::place(Json chart) {
    charts_.push_back(std::move(chart));
    return "<div class=\"place\" data-chart=\"" + std::to_string(charts_.size() - 1) + "\"></div>\n";
}

std::string symbol_of(const std::string& observable) {
    for (const Pair& pair : pairs()) {
        const bool of_pair = pair.observables.front()->key.starts_with(observable) || pair.is(1, observable);
        if (of_pair && !pair.name.empty()) {
            return pair.name;
        }
    }
    const Observable* found = find_observable(observable);
    return found != nullptr ? std::string(found->phrase) : "all numbers";
}

namespace {

/// Measured values that are missing from the chart of a pair, because they were left out.
std::string missing_values(const Measurement& table, const Pair& pair) {
    std::string list;
    for (std::size_t part = 0; part < pair.observables.size(); ++part) {
        const auto count = std::count_if(table.left_out.begin(), table.left_out.end(),
                                         [&](const diagnose::LeftOutCell& cell) { return pair.is(part, cell.column); });
        if (count > 0) {
            list += (list.empty() ? "" : " and ") + std::to_string(count) + " of " + pair.symbol(part);
        }
    }
    return list.empty() ? "" : "<p class=\"soft\">Left out, and not drawn: " + list + " (see cells left out).</p>\n";
}

}  // namespace

std::string table_charts(Charts& charts, const Measurement& table, std::size_t number, const Diagnosis& diagnosis,
                         const std::string& cause) {
    std::string html;
    for (const Pair& pair : pairs()) {
        const Shown shown = rows_of(table, number, diagnosis, pair);
        if (!shown.rows.empty()) {
            html += "<div class=\"pair\">\n" + charts.place(data_chart(shown, diagnosis, cause)) +
                    charts.place(residual_chart(shown, diagnosis, cause)) + "</div>\n" + missing_values(table, pair);
        }
    }
    return html;
}

std::string gain_charts(Charts& charts, const Measurement& table, std::size_t number, const Diagnosis& diagnosis) {
    using diagnose::HeldOutPrediction;
    std::string html;
    for (const Pair& pair : pairs()) {
        const Shown shown = rows_of(table, number, diagnosis, pair);
        Json series = gain_series(shown, diagnosis, "base model", "--base", &HeldOutPrediction::base);
        for (Json& one : gain_series(shown, diagnosis, "with the cause", "--extended", &HeldOutPrediction::extended)) {
            series.push_back(std::move(one));
        }
        for (Json& one : gain_series(shown, diagnosis, "smooth correction", "--smooth", &HeldOutPrediction::flexible)) {
            series.push_back(std::move(one));
        }
        if (!series.empty()) {
            html += charts.place(
                {{"title", table.label + ": rows held out"},
                 {"note", "Error of the prediction by models that have not seen these rows. Circles: " + pair.symbol(0) +
                              (pair.symbol(1).empty() ? "." : "; triangles: " + pair.symbol(1) + ".")},
                 {"x", shown.x.json()},
                 {"y", {{"label", "predicted less measured [% of " + pair.size + "]"}}},
                 {"series", std::move(series)}});
        }
    }
    return html;
}

std::string detection_chart(Charts& charts, const Diagnosis& diagnosis, const std::string& note) {
    if (diagnosis.bootstrap.empty() || diagnosis.statistics.empty()) {
        return {};
    }
    const double observed = diagnosis.statistics.front().score;
    const auto [low, high] = std::minmax_element(diagnosis.bootstrap.begin(), diagnosis.bootstrap.end());
    constexpr int bins = 40;
    const double width = std::max((*high - *low) / bins, 1e-9);
    std::vector<int> counts(bins, 0);
    for (const double score : diagnosis.bootstrap) {
        ++counts[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((score - *low) / width)))];
    }
    Json x = Json::array();
    for (int bin = 0; bin < bins; ++bin) {
        x.push_back(*low + (bin + 0.5) * width);
    }
    if (observed > *high) {  // the axis reaches there
        x.push_back(observed + 2 * width);
        counts.push_back(0);
    }
    return charts.place(
        {{"title", "Misfit of the data beside that of data drawn from the base model"},
         {"note", note},
         {"x", {{"label", "largest standardised misfit"}}},
         {"y", {{"label", "drawn data sets"}}},
         {"marks", {{{"x", observed}, {"label", "the data"}, {"colour", "--base"}}}},
         {"series", {{{"name", "drawn data sets"}, {"kind", "bars"}, {"colour", "--pale-bars"}, {"x", x}, {"y", counts}}}},
         {"height", 230}});
}

}  // namespace coagula::report
