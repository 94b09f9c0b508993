// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/data_notes.hpp>
#include <coagula/report/diagnosis_datasets.hpp>

#include "finding_sentences.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::report {

namespace {

using diagnose::Cause;
using diagnose::Diagnosis;
using diagnose::PredictedRow;

const std::string group = "/diagnosis/";

/// One number of each entry of a list.
template <class List, class Value>
Eigen::VectorXd over(const List& list, const Value& value) {
    Eigen::VectorXd values(static_cast<Index>(list.size()));
    std::transform(list.begin(), list.end(), values.begin(), value);
    return values;
}

template <class List, class Value>
Eigen::VectorXi counted(const List& list, const Value& value) {
    Eigen::VectorXi values(static_cast<Index>(list.size()));
    std::transform(list.begin(), list.end(), values.begin(), [&](const auto& entry) { return static_cast<int>(value(entry)); });
    return values;
}

/// Names, one per line.
template <class List, class Value>
std::string lines(const List& list, const Value& value) {
    std::string text;
    for (const auto& entry : list) {
        text += (text.empty() ? "" : "\n") + value(entry);
    }
    return text;
}

void add_tables(Results& results, const diagnose::Experiment& experiment, const diagnose::ErrorSpec& errors) {
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        const diagnose::Measurement& table = experiment.measurements[k];
        const std::string path = group + "data/table_" + std::to_string(k + 1) + "/";
        results.push_back(io::text(path + "label", table.label, "file and section of the table"));
        results.push_back(io::text(path + "kind", std::string(diagnose::name_of(table.kind)), "kind of the measurement"));
        results.push_back(io::text(path + "sample", table.sample, "tables of one sample share its effect"));
        for (const diagnose::Column& column : table.columns) {
            const auto vector = [](const std::vector<double>& values) {
                return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
            };
            results.push_back(io::vector(path + column.name, vector(column.values), column.unit,
                                         std::string(diagnose::find_quantity(column.name)->meaning) + "; NaN: left out"));
            const diagnose::ColumnErrors* estimated = diagnose::find_errors(errors, k, column.name);
            if (estimated != nullptr || !column.standard_errors.empty()) {
                results.push_back(io::vector(path + "standard_error/" + column.name,
                                             vector(estimated != nullptr ? estimated->deviations : column.standard_errors),
                                             column.unit, "standard deviation of the error of a row"));
            }
        }
        if (!table.left_out.empty()) {
            results.push_back(io::text(path + "left_out",
                                       lines(table.left_out,
                                             [](const auto& cell) {
                                                 return cell.column + "\t" + std::to_string(cell.row + 1) + "\t" + cell.value +
                                                        "\t" + cell.reason;
                                             }),
                                       "cells left out, one per line: column, row from 1, value, reason"));
        }
    }
}

void add_predictions(Results& results, const Diagnosis& found) {
    const std::vector<PredictedRow>& rows = found.rows;
    const std::string path = group + "rows/";
    const auto numbers = [&](const std::string& name, double PredictedRow::*value, const std::string& unit,
                             const std::string& meaning) {
        results.push_back(
            io::vector(path + name, over(rows, [value](const PredictedRow& row) { return row.*value; }), unit, meaning));
    };
    results.push_back(io::integers(path + "table", counted(rows, [](const auto& row) { return row.measurement + 1; }),
                                   "number of the table, from 1; one entry per number that was compared"));
    results.push_back(
        io::integers(path + "row", counted(rows, [](const auto& row) { return row.row + 1; }), "row of the table, from 1"));
    results.push_back(
        io::text(path + "observable", lines(rows, [](const auto& row) { return row.observable; }),
                 "kind of each entry, one per line: a modulus, or a part of the third harmonic over the first, a number of "
                 "neighbours or a share of the void space"));
    results.push_back(io::integers(path + "loss", counted(rows, [](const auto& row) { return row.observable == "loss_modulus"; }),
                                   "1 for a loss modulus, 0 for any other quantity"));
    results.push_back(io::integers(path + "held_out", counted(rows, [](const auto& row) { return row.held_out; }),
                                   "1 for a row held out for the gain"));
    numbers("measured", &PredictedRow::measured, "Pa", "measured values; values other than moduli have no unit");
    numbers("standard_deviation", &PredictedRow::standard_deviation, "Pa", "standard deviation of the error of the row");
    numbers("base", &PredictedRow::base, "Pa", "prediction of the base model, without the effect of the sample");
    numbers("extended", &PredictedRow::extended, "Pa", "prediction with the best cause, without the effect of the sample");
    const std::string fitted = " as fitted: with the effect of the sample and the errors of the simulated structures";
    numbers("base_fitted", &PredictedRow::base_fitted, "Pa", "prediction of the base model" + fitted);
    numbers("extended_fitted", &PredictedRow::extended_fitted, "Pa", "prediction with the best cause" + fitted);
    numbers("base_residual", &PredictedRow::base_residual, "1", "standardised residual without the effects of the samples");
    numbers("extended_residual", &PredictedRow::extended_residual, "1", "standardised residual without the effects of the samples");
    for (const diagnose::OtherPrediction& other : found.others) {
        results.push_back(
            io::vector(path + "others/" + name_of(other.cause),
                       Eigen::Map<const Eigen::VectorXd>(other.values.data(), static_cast<Index>(other.values.size())), "Pa",
                       "prediction with this cause, without the effect of the sample"));
    }
}

void add_detection(Results& results, const Diagnosis& found) {
    const std::string path = group + "detection/";
    results.push_back(io::scalar(path + "p_value", found.p_value, "1",
                                 "fraction of the data sets drawn from the base model with a misfit at least as large"));
    results.push_back(
        io::scalar(path + "extended_p_value", found.extended_p_value, "1", "p-value of the same test of the best cause"));
    results.push_back(io::vector(path + "bootstrap", over(found.bootstrap, [](double value) { return value; }), "1",
                                 "largest standardised misfit of each data set drawn from the base model"));
    results.push_back(
        io::text(path + "statistics",
                 lines(found.statistics, [](const auto& one) { return one.measure + "\t" + one.observable + "\t" + one.axis; }),
                 "misfit statistics, one per line: measure, observable, axis"));
    results.push_back(io::vector(path + "value", over(found.statistics, [](const auto& one) { return one.value; }), "1",
                                 "value of each statistic"));
    results.push_back(io::vector(path + "score", over(found.statistics, [](const auto& one) { return one.score; }), "1",
                                 "standardised value of each statistic"));
    for (std::size_t k = 0; k < found.misfits.size(); ++k) {
        const diagnose::Misfit& misfit = found.misfits[k];
        const std::string place = group + "where/" + std::to_string(k + 1) + "/";
        results.push_back(io::text(place + "sentence", sentence_on(misfit), misfit.observable + " along " + misfit.axis));
        results.push_back(io::scalar(place + "log_bayes_factor", misfit.log_bayes_factor, "1",
                                     "natural logarithm of the Bayes factor of a smooth deviation against none"));
    }
}

void add_causes(Results& results, const Diagnosis& found) {
    const std::string path = group + "causes/";
    results.push_back(io::text(path + "names", lines(found.causes, [](const Cause& cause) { return cause.name(); }),
                               "causes that were compared, most probable first, one per line"));
    results.push_back(io::vector(path + "posterior", over(found.causes, [](const Cause& cause) { return cause.posterior; }), "1",
                                 "probability of each cause"));
    results.push_back(io::vector(path + "log_evidence", over(found.causes, [](const Cause& cause) { return cause.log_evidence; }),
                                 "1", "logarithm of the evidence of each cause"));
    std::vector<const Cause*> all{&found.base};
    for (const Cause& cause : found.causes) {
        if (!cause.set.is_base() && !cause.parameters.empty()) {
            all.push_back(&cause);
        }
    }
    for (const Cause* cause : all) {
        for (std::size_t k = 0; k < cause->parameters.size(); ++k) {
            const diagnose::EstimatedParameter& parameter = cause->parameters[k];
            const std::string place = group + "parameters/" + cause->name() + "/" + parameter.name + "/";
            results.push_back(io::scalar(place + "value", parameter.value, parameter.unit, "most probable value"));
            results.push_back(io::scalar(place + "low", parameter.low, parameter.unit, "5 % quantile"));
            results.push_back(io::scalar(place + "high", parameter.high, parameter.unit, "95 % quantile"));
            if (static_cast<Index>(k) < cause->draws.rows()) {
                results.push_back(io::vector(place + "draws", cause->draws.row(static_cast<Index>(k)).transpose(), parameter.unit,
                                             "equally probable draws from the posterior, joint over the parameters"));
            }
        }
    }
}

void add_gain(Results& results, const diagnose::Gain& gain) {
    const std::string path = group + "gain/";
    const auto number = [&](const std::string& name, double value, const std::string& meaning) {
        if (std::isfinite(value)) {
            results.push_back(io::scalar(path + name, value, "1", meaning));
        }
    };
    number("rmse_base", gain.rmse_base, "rms error over |G*| on held-out rows, base model");
    number("rmse_extended", gain.rmse_extended, "rms error over |G*| on held-out rows, best cause");
    number("rmse_flexible", gain.rmse_flexible, "rms error over |G*| on held-out rows, base model with a smooth correction");
    number("elpd_difference", gain.elpd_difference, "difference in log predictive density, extended less base");
    number("elpd_low", gain.elpd_low, "5 % quantile by block bootstrap");
    number("elpd_high", gain.elpd_high, "95 % quantile by block bootstrap");
    const auto& rows = gain.predictions;
    results.push_back(io::integers(path + "entry", counted(rows, [](const auto& row) { return row.row; }),
                                   "held-out moduli as entries of /diagnosis/rows, from 0"));
    const auto column = [&](const std::string& name, double diagnose::HeldOutPrediction::*value, const std::string& meaning) {
        results.push_back(io::vector(path + name, over(rows, [value](const auto& row) { return row.*value; }), "Pa",
                                     meaning + ", fitted without these rows"));
    };
    column("base", &diagnose::HeldOutPrediction::base, "base model");
    column("extended", &diagnose::HeldOutPrediction::extended, "best cause");
    column("flexible", &diagnose::HeldOutPrediction::flexible, "base model with a smooth correction");
}

void add_noise(Results& results, const DiagnosisRecord& record) {
    for (const diagnose::NoiseModel& noise : record.noise) {
        const std::string path = group + "noise/" + std::string(diagnose::name_of(noise.kind)) + "/" + noise.observable + "/";
        if (std::any_of(results.begin(), results.end(), [&](const io::Dataset& one) { return one.path == path + "statement"; })) {
            continue;  // tables of this kind at other conditions: the noise that is used is that of the first
        }
        results.push_back(io::text(path + "statement", source_of(noise), "source of the numbers"));
        const auto estimate = [&](const std::string& name, const diagnose::Estimate& value, const std::string& unit,
                                  const std::string& meaning) {
            results.push_back(io::vector(path + name, Eigen::Vector3d(value.value, value.low, value.high), unit,
                                         meaning + ": value, 95 % interval"));
        };
        estimate("floor", noise.floor, diagnose::floor_unit(noise), noise.floor_of_stress ? "floor of the stress" : "floor");
        estimate("relative", noise.relative, "1", "relative part");
        estimate("sample", noise.sample, "1", "effect of a sample");
        results.push_back(
            io::scalar(path + "autocorrelation", noise.autocorrelation, "1", "correlation of neighbouring residuals"));
    }
    const auto effects = [&](const std::string& name, const std::vector<diagnose::SampleEffect>& list, const std::string& model) {
        results.push_back(io::vector(group + "samples/" + name, over(list, [](const auto& effect) { return effect.effect; }), "1",
                                     "most probable effect b of each sample, prediction x (1 + b), " + model));
    };
    results.push_back(io::text(group + "samples/names",
                               lines(record.diagnosis.base_effects, [](const auto& effect) { return effect.sample; }),
                               "samples, one per line"));
    effects("base_effect", record.diagnosis.base_effects, "base model");
    effects("extended_effect", record.diagnosis.extended_effects, "best cause");
}

void add_provenance(Results& results, const io::Provenance& provenance, const std::vector<std::string>& structures) {
    const std::string path = "/provenance/0001_diagnose/";
    results.push_back(io::text(path + "command_line", provenance.command_line, "command line, which can be typed again"));
    results.push_back(io::text(path + "options", provenance.options, "JSON object of all options"));
    results.push_back(io::integer(path + "seed", provenance.seed, "seed of the random numbers"));
    results.push_back(io::text(path + "version", provenance.version, "version of coagula with its git revision"));
    results.push_back(io::text(path + "time", provenance.time, "time of the call, UTC"));
    results.push_back(io::scalar(path + "seconds", provenance.seconds, "s", "wall-clock time of the call"));
    results.push_back(io::text(path + "structures", lines(structures, [](const std::string& one) { return one; }),
                               "structures that were simulated, one per line"));
}

}  // namespace

Results datasets_of(const DiagnosisRecord& record) {
    const Diagnosis& found = record.diagnosis;
    Results results;
    std::string verdict;
    for (const std::string& sentence : verdict_sentences(found)) {
        verdict += (verdict.empty() ? "" : " ") + sentence;
    }
    results.push_back(io::text(group + "verdict", diagnose::name_of(found.verdict), verdict));
    results.push_back(io::text(group + "credible_set", lines(found.credible_set, [](const auto& set) { return name_of(set); }),
                               "smallest set of causes with 95 % of the posterior, one per line"));
    results.push_back(io::text(group + "certain_causes", lines(names_in(found.certain), [](const auto& name) { return name; }),
                               "causes that every member of that set is or has, one per line"));
    add_tables(results, record.experiment, record.errors);
    add_predictions(results, found);
    add_detection(results, found);
    add_causes(results, found);
    if (found.detected && found.gain.held_out > 0) {
        add_gain(results, found.gain);
    }
    add_noise(results, record);
    add_provenance(results, record.provenance, record.structures);
    return results;
}

}  // namespace coagula::report
