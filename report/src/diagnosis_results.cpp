// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/data_notes.hpp>
#include <coagula/report/diagnosis_page.hpp>
#include <coagula/report/diagnosis_results.hpp>

#include "finding_sentences.hpp"
#include "html.hpp"
#include "verdict_sentences.hpp"

#include <cmath>

namespace coagula::report {

namespace {

using diagnose::Cause;
using diagnose::Diagnosis;

Json number(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json parameters_json(const Cause& cause) {
    Json json = Json::object();
    for (const diagnose::EstimatedParameter& parameter : cause.parameters) {
        json[parameter.name] = {{"value", number(parameter.value)},
                                {"low", number(parameter.low)},
                                {"high", number(parameter.high)},
                                {"unit", parameter.unit}};
        if (parameter.at_end) {
            json[parameter.name]["at_end_of_range"] = true;
        }
    }
    return json;
}

Json cause_json(const Cause& cause) {
    return {{"name", cause.name()},
            {"posterior", cause.posterior},
            {"log_evidence", number(cause.log_evidence)},
            {"leaves_remainder", cause.leaves_remainder},
            {"words", cause.words},
            {"parameters", parameters_json(cause)}};
}

/// Unit of an axis: that of its column.
std::string unit_of(const std::string& axis) {
    const diagnose::Quantity* quantity = diagnose::find_quantity(axis);
    return quantity != nullptr ? std::string(quantity->unit) : axis == "normal_stiffness" ? "N/m" : "1";
}

/// What the prediction of each sample is multiplied with, less 1.
Json effects_json(const std::vector<diagnose::SampleEffect>& effects) {
    Json json = Json::object();
    for (const diagnose::SampleEffect& effect : effects) {
        json[effect.sample] = effect.effect;
    }
    return json;
}

Json row_json(const diagnose::PredictedRow& row) {
    Json json{{"measurement", row.measurement + 1},
              {"row", row.row + 1},
              {"observable", row.observable},
              {"measured", row.measured},
              {"standard_deviation", row.standard_deviation},
              {"base", row.base},
              {"extended", row.extended},
              {"held_out", row.held_out}};
    if (std::isfinite(row.distance)) {
        json["distance"] = row.distance;
    }
    return json;
}

Json kinds_json(const std::vector<diagnose::FollowedKind>& kinds) {
    Json json = Json::array();
    for (const diagnose::FollowedKind& one : kinds) {
        json.push_back({{"link", diagnose::name_of(one.kind.link)},
                        {"axis", diagnose::name_of(one.kind.axis)},
                        {"posterior", one.posterior},
                        {"log_factor", number(one.log_factor)}});
    }
    return json;
}

Json follows_json(const diagnose::Follows& follows) {
    return {{"link", diagnose::name_of(follows.kind.link)},
            {"axis", diagnose::name_of(follows.kind.axis)},
            {"posterior", follows.posterior},
            {"link_is_told", follows.link_is_told},
            {"change", number(follows.change)},
            {"largest", number(follows.largest)},
            {"from", number(follows.from)},
            {"to", number(follows.to)},
            {"sample", follows.sample.empty() ? Json(nullptr) : Json(follows.sample)}};
}

Json conditions_json(const std::vector<diagnose::Condition>& conditions) {
    Json json = Json::array();
    for (const diagnose::Condition& one : conditions) {
        json.push_back({{"name", one.name}, {"value", number(one.value)}, {"limit", one.limit}, {"holds", one.holds}});
    }
    return json;
}

std::string describe(const Cause& cause) {
    std::string text = "probability " + probability_text(cause.posterior);
    for (const diagnose::EstimatedParameter& parameter : cause.parameters) {
        const std::string low = with_unit(parameter.low, parameter.unit);
        const std::string high = with_unit(parameter.high, parameter.unit);
        text += "; " + parameter.name +
                (leaves_open(parameter) ? " between " + low + " and " + high
                                        : " " + with_unit(parameter.value, parameter.unit) + " (" + low + " to " + high + ")") +
                (parameter.at_end ? ", the end of its range" : "");
    }
    return text;
}

std::string describe(const diagnose::Follows& follows) {
    std::string text = axis_in_words(follows) + " (link: " + diagnose::name_of(follows.kind.link) +
                       (follows.link_is_told ? "" : " or another one") + "), probability " + probability_text(follows.posterior);
    if (std::isfinite(follows.largest)) {
        text += "; up to " + with_unit(100 * follows.largest, "1") + " % of |G*|";
    }
    if (std::isfinite(follows.change) && std::isfinite(follows.from)) {
        text += ", " + with_unit(100 * follows.change, "1") + " % from end to end";
    }
    return text;
}

/// Names of the conditions of a name that do not hold.
std::string missing_conditions(const std::vector<diagnose::Condition>& conditions) {
    std::vector<std::string> missing;
    for (const diagnose::Condition& one : conditions) {
        if (!one.holds) {
            missing.push_back(one.name);
        }
    }
    return list_of(missing);
}

Json estimate_json(const diagnose::Estimate& estimate, const std::string& unit) {
    return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}, {"unit", unit}};
}

std::string describe(const diagnose::Gain& gain) {
    if (gain.held_out == 0) {
        return "none, because there are too few rows to hold some out";
    }
    const auto percent = [](double part) { return with_unit(100 * part, "1") + " %"; };
    return "error " + percent(gain.rmse_base) + " with the base model, " + percent(gain.rmse_extended) +
           " with the cause chosen on the other rows (" + percent(gain.rmse_flexible) +
           " with a smooth correction); change of the log predictive density " +
           change_of_density(gain, [](double value) { return with_unit(value, "1"); });
}

}  // namespace

std::string change_of_density(const diagnose::Gain& gain, const std::function<std::string(double)>& print) {
    const std::string change = (gain.elpd_difference < 0 ? "" : "+") + print(gain.elpd_difference);
    return std::isnan(gain.elpd_low) ? change + " (too few rows for an interval)"
                                     : change + " (90 % interval " + print(gain.elpd_low) + " to " + print(gain.elpd_high) + ")";
}

bool is_least_p(const Diagnosis& diagnosis) {
    return diagnosis.p_value * static_cast<double>(diagnosis.bootstrap.size() + 1) < 1.5;
}

Json noise_json(const diagnose::NoiseModel& noise) {
    Json json = {{"kind", diagnose::name_of(noise.kind)},
                 {"observable", noise.observable},
                 {"tables", noise.tables},
                 {"samples", noise.samples},
                 {"values", noise.values},
                 {"rows_estimated", noise.rows_estimated},
                 {"sample_estimated", noise.sample_estimated},
                 {"floor", estimate_json(noise.floor, diagnose::floor_unit(noise))},
                 {"floor_of_stress", noise.floor_of_stress},
                 {"relative", estimate_json(noise.relative, "1")},
                 {"sample", estimate_json(noise.sample, "1")},
                 {"autocorrelation", noise.autocorrelation},
                 {"excess_kurtosis", noise.excess_kurtosis},
                 {"sample_effects", effects_json(noise.sample_effects)},
                 {"statement", source_of(noise)}};
    return json;
}

Json to_json(const Diagnosis& diagnosis, const std::vector<diagnose::NoiseModel>& noise, const std::string& model) {
    Json json = {{"detected", diagnosis.detected},
                 {"p_value", diagnosis.p_value},
                 {"verdict", diagnose::name_of(diagnosis.verdict)},
                 {"observations", diagnosis.observations},
                 {"base", cause_json(diagnosis.base)},
                 {"causes", Json::array()},
                 {"credible_set", names_of(diagnosis.credible_set)},
                 {"certain_causes", names_in(diagnosis.certain)},
                 {"where", Json::array()},
                 {"rows", Json::array()}};
    for (const Cause& cause : diagnosis.causes) {
        json["causes"].push_back(cause_json(cause));
    }
    for (const diagnose::Misfit& misfit : diagnosis.misfits) {
        json["where"].push_back({{"observable", misfit.observable},
                                 {"axis", misfit.axis},
                                 {"bayes_factor", number(std::exp(misfit.log_bayes_factor))},
                                 {"log_bayes_factor", number(misfit.log_bayes_factor)},
                                 {"from", number(misfit.from)},
                                 {"unit", unit_of(misfit.axis)},
                                 {"sentence", sentence_on(misfit)}});
    }
    for (const diagnose::PredictedRow& row : diagnosis.rows) {
        json["rows"].push_back(row_json(row));
    }
    if (diagnosis.detected) {
        const diagnose::Gain& gain = diagnosis.gain;
        json["extended_p_value"] = diagnosis.extended_p_value;
        json["follows"] = follows_json(diagnosis.follows);
        json["kinds"] = kinds_json(diagnosis.kinds);
        json["conditions"] = conditions_json(diagnosis.conditions);
        json["level_alone"] = diagnosis.level_alone;
        json["remainder"] = {{"detected", diagnosis.remainder.detected},
                             {"p_value", diagnosis.remainder.p_value},
                             {"where", sentence_on(diagnosis.remainder)},
                             {"most", diagnosis.remainder.most}};
        json["gain"] = {{"held_out", gain.held_out},
                        {"chosen", names_of(gain.chosen)},
                        {"rmse_base", number(gain.rmse_base)},
                        {"rmse_extended", number(gain.rmse_extended)},
                        {"rmse_flexible", number(gain.rmse_flexible)},
                        {"rmse_ratio", number(gain.rmse_ratio)},
                        {"elpd_difference", number(gain.elpd_difference)},
                        {"elpd_ci90", {number(gain.elpd_low), number(gain.elpd_high)}}};
    }
    json["noise"] = {{"sample", diagnosis.sample_deviation}, {"tables", Json::array()}};
    for (const diagnose::NoiseModel& one : noise) {
        json["noise"]["tables"].push_back(noise_json(one));
    }
    json["sample_effects"] = {{"base", effects_json(diagnosis.base_effects)},
                              {"extended", effects_json(diagnosis.extended_effects)}};
    json["proposed_measurements"] = Json::array();
    for (const diagnose::Proposal& proposal : diagnosis.proposals) {
        json["proposed_measurements"].push_back(
            {{"what", words_for(proposal)}, {"information", proposal.information}, {"predicted_resolution", proposal.resolution}});
    }
    if (!diagnosis.proposals.empty()) {
        json["proposed_measurement"] = json["proposed_measurements"].front();
    }
    json["extended_model"] = model.empty() ? Json(nullptr) : Json(model);
    return json;
}

Table table_of(const Diagnosis& diagnosis) {
    Table lines{{"measured numbers", std::to_string(diagnosis.observations)},
                {"verdict", std::string(diagnose::name_of(diagnosis.verdict)) +
                                (is_least_p(diagnosis) ? "   (p-value of the base model <= " : "   (p-value of the base model ") +
                                with_unit(diagnosis.p_value, "1") + ")"}};
    if (!diagnosis.detected) {
        return lines;
    }
    for (const diagnose::Misfit& misfit : diagnosis.misfits) {
        lines.emplace_back("where", sentence_on(misfit));
    }
    lines.emplace_back("follows", describe(diagnosis.follows));
    lines.emplace_back("95 % set of causes", list_of(names_of(diagnosis.credible_set)));
    if (diagnosis.credible_set.size() > 1 && !diagnosis.certain.is_base()) {
        lines.emplace_back("in every member of that set", list_of(names_in(diagnosis.certain)));
    }
    for (const Cause& cause : diagnosis.causes) {
        if (cause.posterior > 0.01) {
            lines.emplace_back("  " + cause.name(), describe(cause));
        }
    }
    if (const std::string missing = missing_conditions(diagnosis.conditions); !missing.empty()) {
        lines.emplace_back("missing to a name", missing);
    }
    if (diagnosis.remainder.detected) {
        lines.emplace_back("remaining deviation",
                           sentence_on(diagnosis.remainder) + "   (p-value " + with_unit(diagnosis.remainder.p_value, "1") + ")");
    }
    lines.emplace_back("gain on held-out data", describe(diagnosis.gain));
    if (!diagnosis.proposals.empty()) {
        const diagnose::Proposal& first = diagnosis.proposals.front();
        lines.emplace_back("measure next",
                           words_for(first) + "   (decides with probability " + probability_text(first.resolution) + ")");
    } else if (const std::string by = what_separates(diagnosis); !by.empty()) {
        lines.emplace_back("measure next", by);
    }
    return lines;
}

}  // namespace coagula::report
