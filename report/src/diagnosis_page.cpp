// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/diagnosis_page.hpp>

#include "bundle.hpp"
#include "diagnosis_charts.hpp"
#include "diagnosis_data_page.hpp"
#include "diagnosis_tables.hpp"
#include "finding_sentences.hpp"
#include "html.hpp"
#include "verdict_sentences.hpp"

#include <coagula/diagnose/observable.hpp>
#include <coagula/report/diagnosis_results.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::report {

namespace {

using diagnose::Cause;
using diagnose::Diagnosis;

constexpr double shown_from = 0.001;  ///< smallest probability of a cause with a line of its own

std::string print_number(double value) {
    return printed(value);
}

std::string header(const DiagnosisRecord& record) {
    const Diagnosis& found = record.diagnosis;
    const std::string title = record.experiment.title.empty() ? "Diagnosis of measured moduli" : record.experiment.title;
    std::string html = "<header>\n<div class=\"title\" id=\"title\"><h1>" + escaped(title) + "</h1></div>\n";
    const std::string sample = record.experiment.sample.name;
    html += paragraph((sample.empty() ? "" : escaped(sample) + " · ") + "diagnosis by coagula · " + record.provenance.time, "soft");
    html += std::string("<div class=\"verdict ") + diagnose::name_of(found.verdict) + "\">";
    for (const std::string& sentence : verdict_sentences(found)) {
        html += paragraph(escaped(sentence));
    }
    html += "</div>\n<dl class=\"facts\">\n";
    const auto fact = [&](const std::string& name, const std::string& value) {
        html += "<div><dt>" + name + "</dt><dd>" + value + "</dd></div>\n";
    };
    fact("verdict", diagnose::name_of(found.verdict));
    fact("p-value of the base model", chance_text(found));
    fact("measured numbers", std::to_string(found.observations));
    if (found.detected && found.gain.held_out > 0) {
        fact("error on held-out rows", percent(found.gain.rmse_base) + " → " + percent(found.gain.rmse_extended));
    }
    return html + "</dl>\n</header>\n";
}

std::string base_model_text(const diagnose::Material& material) {
    switch (material.kind) {
        case diagnose::MaterialKind::newtonian:
            return "The base model is a Newtonian liquid under a perfect instrument. It has one parameter, the viscosity.";
        case diagnose::MaterialKind::smooth:
            return std::string("The base model is any material whose moduli are smooth in frequency") +
                   (material.ages ? ", strain and age" : " and strain") + ", under a perfect instrument.";
        default:
            return "The base model – linear normal and shear springs, bonds without moments, no loss – has one free parameter, the "
                   "stiffness of the particles.";
    }
}

std::string detection(const DiagnosisRecord& record, Charts& charts) {
    const Diagnosis& found = record.diagnosis;
    std::string html = heading("Where the base model fails");
    html += paragraph(base_model_text(record.experiment.material));
    if (found.misfits.empty()) {
        html += paragraph(found.detected ? "It fails as a whole: no smooth deviation along a single axis stands out."
                                         : "It does not fail: every misfit is as small as chance allows.");
    } else {
        html += "<ul class=\"findings\">\n";
        for (const diagnose::Misfit& misfit : found.misfits) {
            html += "<li>" + escaped(sentence_on(misfit)) + ". <span class=\"soft\">Bayes factor " +
                    (misfit.log_bayes_factor > std::log(1e6) ? "above 10⁶" : printed(std::exp(misfit.log_bayes_factor))) +
                    ".</span></li>\n";
        }
        html += "</ul>\n";
    }
    const std::string what =
        found.statistics.empty()
            ? ""
            : found.statistics.front().measure +
                  (found.statistics.front().axis == "none"
                       ? ""
                       : " of " + symbol_of(found.statistics.front().observable) + " along " + found.statistics.front().axis);
    return html + detection_chart(charts, found,
                                  "The largest of " + std::to_string(found.statistics.size()) +
                                      " standardised misfit statistics (here: " + replaced(what, "_", " ") + ") beside that of " +
                                      std::to_string(found.bootstrap.size()) + " data sets drawn from the fitted base model: " +
                                      chance_text(found) + "; the test decides at " + printed(100 * record.level) + " %.");
}

/// What a logarithmic axis shows of numbers that are not above zero: with measured ones among them both signs, else nothing.
std::string below_zero(const Diagnosis& found, std::size_t table) {
    bool measured = false;
    bool base = false;
    for (const diagnose::PredictedRow& row : found.rows) {
        measured =
            measured || (row.measurement == table && diagnose::observable_named(row.observable).unit == "Pa" && row.measured <= 0);
        base = base || (row.measurement == table && row.observable == "loss_modulus" && row.base <= 0);
    }
    return measured ? " Moduli below zero are shown: a logarithmic axis is linear about zero."
           : base   ? " The base model has no loss: its G'' = 0 is not on a logarithmic axis."
                    : "";
}

std::string data_and_models(const DiagnosisRecord& record, Charts& charts) {
    const Diagnosis& found = record.diagnosis;
    const Cause* cause = best_cause(found);
    std::string html = heading("Measured data against the models") + "<div id=\"models\"></div>\n";
    for (std::size_t k = 0; k < record.experiment.measurements.size(); ++k) {
        const diagnose::Measurement& table = record.experiment.measurements[k];
        const auto rows =
            std::count_if(found.rows.begin(), found.rows.end(), [&](const auto& row) { return row.measurement == k; });
        html += "<h3>" + escaped(table.label) + " <span class=\"soft\">· " + escaped(conditions_of(table)) + "</span></h3>\n";
        if (rows == 0) {
            html += paragraph("Tables of this kind are read and checked, but do not take part in the diagnosis.", "soft");
            continue;
        }
        const auto effect = std::find_if(found.base_effects.begin(), found.base_effects.end(),
                                         [&](const auto& one) { return one.sample == table.sample; });
        const std::string extended = cause == nullptr ? "" : cause->name();
        html += image_table(found, k, extended);
        html += table_charts(charts, table, k, found, extended);
        html += paragraph(
            "Circles show the elastic part or the quantity itself, triangles the viscous part or neighbours along z; open symbols "
            "are held out for the gain, and bars are one standard deviation. Models are drawn as they were fitted, with the errors "
            "of the simulated structures" +
                (effect == found.base_effects.end() || effect->effect == 0
                     ? std::string{}
                     : " and the effect of the sample, " + signed_percent(effect->effect) + " for the base model") +
                ". The residual is the measured less the fitted value over the standard deviation, freed from the correlation of "
                "neighbouring rows; the grey band is two standard deviations wide on each side." +
                below_zero(found, k),
            "soft");
    }
    return html;
}

std::string causes(const Diagnosis& found) {
    std::string html = heading("Causes");
    html += paragraph(
        "The bars show the probability of each cause, given the data and the physical range of its parameters. " +
        (found.credible_set.empty() ? std::string{}
                                    : "The 95 % set: <b>" + escaped(joined(names_of(found.credible_set))) + "</b>.") +
        " The test of the base model, applied to the best cause, gives p = " + print_number(found.extended_p_value) + "." +
        (found.remainder.detected ? (found.remainder.most ? " Most of the deviation remains: " : " A deviation remains: ") +
                                        escaped(sentence_on(found.remainder)) + "."
                                  : std::string{}) +
        (found.level_alone
             ? " Only the level of the moduli deviates. A wrong value of the structure, the particles or the instrument "
               "would look the same."
             : std::string{}));
    std::vector<std::vector<std::string>> rows;
    std::size_t improbable = 0;
    for (const Cause& cause : found.causes) {
        if (cause.posterior < shown_from && rows.size() >= 3) {
            ++improbable;
            continue;
        }
        const auto& set = found.credible_set;
        const bool inside = std::find(set.begin(), set.end(), cause.set) != set.end();
        rows.push_back({"<span class=\"name\">" + escaped(cause.name()) + "</span>",
                        std::string("<div class=\"") + (inside ? "inside" : "outside") +
                            "\"><div class=\"bar\"><span style=\"width:" +
                            replaced(printed(100 * std::max(cause.posterior, 0.002)), "−", "-") + "%\"></span></div></div>",
                        "<span class=\"number\">" + escaped(probability_text(cause.posterior)) + "</span>", escaped(cause.words)});
    }
    html += html_table({"cause", "", "probability", "what it changes"}, rows, "bars");
    return html + (improbable == 0
                       ? std::string{}
                       : paragraph(std::to_string(improbable) + " further causes have a probability below 0.1 % each.", "soft"));
}

std::string parameters(const Diagnosis& found) {
    std::string html = heading("Parameters");
    std::vector<std::vector<std::string>> rows;
    const auto add = [&](const Cause& cause) {
        for (const diagnose::EstimatedParameter& parameter : cause.parameters) {
            rows.push_back({"<span class=\"name\">" + escaped(cause.name()) + "</span>", readable(parameter.name),
                            "<span class=\"number\">" +
                                (leaves_open(parameter) ? "open" : printed(parameter.value, parameter.unit)) + "</span>",
                            printed(parameter.low, parameter.unit) + " to " + printed(parameter.high, parameter.unit) +
                                (parameter.at_end ? " <b>(the end of its range)</b>" : "")});
        }
    };
    add(found.base);
    const Cause* drawn = best_cause(found);
    for (const Cause& cause : found.causes) {
        const auto& set = found.credible_set;
        const bool inside = std::find(set.begin(), set.end(), cause.set) != set.end();
        if ((inside || &cause == drawn) && !cause.set.is_base()) {
            add(cause);
        }
    }
    return rows.empty() ? "" : html + html_table({"model", "parameter", "most probable", "90 % interval"}, rows);
}

std::string gain(const DiagnosisRecord& record, Charts& charts) {
    const diagnose::Gain& gain = record.diagnosis.gain;
    std::string html = heading("Gain on data held out");
    if (gain.held_out == 0) {
        return html + paragraph("There are too few rows to hold some out.");
    }
    html += paragraph(std::to_string(gain.held_out) + " numbers were held out" + (gain.chosen.size() > 1 ? " in turn" : "") +
                      "; the cause was chosen and fitted on the rest (" + escaped(list_of(names_of(gain.chosen))) +
                      "). Their prediction misses by " + percent(gain.rmse_base) + " of |G*| (rms) with the base model, by " +
                      percent(gain.rmse_flexible) + " with a smooth correction of it, and by <b>" + percent(gain.rmse_extended) +
                      "</b> with that cause: a factor of " + printed(gain.rmse_ratio) + ". The log predictive density changes by " +
                      change_of_density(gain, print_number) + ".");
    for (std::size_t k = 0; k < record.experiment.measurements.size(); ++k) {
        html += gain_charts(charts, record.experiment.measurements[k], k, record.diagnosis);
    }
    return html;
}

std::string proposals(const Diagnosis& found) {
    if (found.proposals.empty()) {
        return {};
    }
    std::vector<std::vector<std::string>> rows;
    for (const diagnose::Proposal& proposal : found.proposals) {
        rows.push_back({escaped(words_for(proposal)),
                        "<span class=\"number\">" + escaped(probability_text(proposal.resolution)) + "</span>",
                        "<span class=\"number\">" + printed(proposal.information) + " bit</span>"});
    }
    return heading("What to measure next") +
           paragraph("These measurements would separate the causes of the 95 % set, the most informative first.") +
           html_table({"measurement", "decides with probability", "expected information"}, rows);
}

std::string made(const DiagnosisRecord& record) {
    std::string html = heading("How this was made") + "<dl class=\"made\">\n";
    const auto line = [&](const std::string& name, const std::string& value) {
        html += "<dt>" + name + "</dt><dd>" + value + "</dd>\n";
    };
    line("command", "<code>" + escaped(record.provenance.command_line) + "</code>");
    line("version", "coagula " + escaped(record.provenance.version));
    line("seed", std::to_string(record.provenance.seed));
    line("time", record.provenance.time + ", " + printed(record.provenance.seconds) + " s");
    for (const std::string& structure : record.structures) {
        line("structure", escaped(structure));
    }
    for (const std::string& call : record.calls) {
        line("structure of the best cause", "<code>" + escaped(call) + "</code>");
    }
    line("numbers", "<code>diagnosis.json</code>, and everything behind them in <code>diagnosis.h5</code>" +
                        (record.model.empty() ? std::string{}
                                              : "; the contact of the best cause for <code>coagula shear --model</code> in "
                                                "<code>extended_model.toml</code>"));
    return html + "</dl>\n";
}

}  // namespace

std::string diagnosis_page(const DiagnosisRecord& record) {
    const Diagnosis& found = record.diagnosis;
    Charts charts;
    std::string body = data_and_models(record, charts) + detection(record, charts);
    if (found.detected) {
        body += causes(found);
    }
    body += parameters(found);
    if (found.detected) {
        body += gain(record, charts) + proposals(found);
    }
    body += noise_section(record.noise) + left_out_section(record.experiment) + made(record);
    std::string head = header(record);
    for (const std::string& note : record.notes) {
        head += paragraph("Note: " + escaped(note) + ".", "soft");
    }
    if (diagnosis_script.empty()) {
        head +=
            paragraph("The figures are missing because this program was built without its pages (scripts/bundle-web).", "missing");
    }
    Json data = {{"charts", charts.all()}, {"causes", Json::array()}};
    for (const Cause& cause : found.causes) {
        data["causes"].push_back({{"name", "with " + cause.name()}, {"probability", probability_text(cause.posterior)}});
    }
    return html_page((record.experiment.title.empty() ? "Diagnosis" : record.experiment.title) + " – coagula",
                     head + body + page_data(data) + page_script(diagnosis_script), "text");
}

}  // namespace coagula::report
