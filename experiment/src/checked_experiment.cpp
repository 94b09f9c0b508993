// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/stress_control.hpp>
#include <coagula/diagnose/waveform.hpp>
#include <coagula/experiment/checked_experiment.hpp>

#include "copied_tables.hpp"
#include "liquid.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace coagula::experiment {

namespace {

/// Plans, and copies: replicates are never the same to the last digit.
void refuse_what_was_not_measured(const std::vector<diagnose::Measurement>& tables) {
    for (auto table = tables.begin(); table != tables.end(); ++table) {
        if (table->label.ends_with("(planned)")) {
            throw InputError(table->label + ": a planned table has no measured moduli; give --power to judge the plan");
        }
        const auto copy = std::find_if(tables.begin(), table, [&](const auto& other) {
            return table->kind != diagnose::MeasurementKind::waveform && likeness(*table, other) != Likeness::none;
        });
        if (copy != table) {
            const bool rounded = likeness(*table, *copy) == Likeness::rounded;
            throw InputError(table->label + ", sample '" + table->sample + "': the same numbers as in " + copy->label +
                             ", sample '" + copy->sample + "'" + (rounded ? ", but for their rounding" : "") +
                             "; give each measurement once");
        }
    }
}

/// What a table lacks that its kind needs; nothing where it lacks nothing.
std::string missing_column(const diagnose::Measurement& table) {
    const diagnose::TableRule rule = diagnose::rule_of(table.kind);
    if (!rule.axes.empty() && diagnose::axis_of(table) == nullptr) {
        return std::string(rule.axes.front());
    }
    const auto absent = std::find_if(rule.required.begin(), rule.required.end(),
                                     [&](std::string_view name) { return diagnose::find_column(table, name) == nullptr; });
    return absent == rule.required.end() ? "" : std::string(*absent);
}

/// The line that may make up for a missing column.
std::string remedy(const diagnose::Measurement& table, const TableFacts& facts) {
    const std::string missing = missing_column(table);
    if (missing.empty() || facts.not_understood.empty()) {
        return "";
    }
    std::string list = list_of(facts.not_understood);
    const std::string& first = facts.not_understood.front();
    list += ": if one of them is it, add to the measurement, say, columns = { " + missing + " = \"";
    list += first.substr(1, first.size() - 2) + "\" }";
    return "; not understood are the columns " + list;
}

std::vector<diagnose::CheckedMeasurement> check_tables(const ExperimentFile& file) {
    const std::vector<diagnose::Measurement>& tables = file.experiment.measurements;
    refuse_what_was_not_measured(tables);
    std::vector<diagnose::CheckedMeasurement> checked;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const bool liquid = file.experiment.material.kind == diagnose::MaterialKind::newtonian;
        checked.push_back(diagnose::check_data(tables[i], {.liquid = liquid}));
        if (!checked.back().problems.empty()) {
            throw InputError(checked.back().problems.front() + remedy(tables[i], file.facts[i]));
        }
    }
    return checked;
}

/// Writes gap and plate radius of the instrument into the tables that inherit them, where other tables state their own. Tables of
/// the same geometry then have the same value.
void state_inherited(diagnose::Experiment& experiment) {
    for (const auto& [name, value] :
         {std::pair{"gap", experiment.instrument.gap}, std::pair{"plate_radius", experiment.instrument.plate_radius}}) {
        const auto states = [&, name = name](const auto& table) { return diagnose::find_column(table, name) != nullptr; };
        if (std::isnan(value) || std::none_of(experiment.measurements.begin(), experiment.measurements.end(), states)) {
            continue;
        }
        for (diagnose::Measurement& table : experiment.measurements) {
            const bool under_cone = std::isfinite(table.cone_angle);  // where there is no gap
            const bool shears = diagnose::has_moduli(table.kind) || diagnose::is_flow(table.kind);
            if (shears && !states(table) && !(under_cone && std::string_view(name) == "gap")) {
                table.columns.push_back({name, "m", std::vector<double>(table.rows(), value)});
            }
        }
    }
}

/// Whose strain is no coordinate, because it followed.
void note_set_stresses(CheckedExperiment& found) {
    for (const diagnose::Measurement& table : found.file.experiment.measurements) {
        if (!table.stress_controlled && diagnose::is_stress_controlled(table)) {
            found.findings.emplace_back(
                table.label + ", sample '" + table.sample +
                "': the stress stays while the strain changes from row to row, so that the stress is taken for "
                "what was set and the strain for what followed; if it was not, say control = \"strain\"");
        }
    }
}

/// A network cannot show what a liquid does.
void note_liquids(CheckedExperiment& found) {
    const bool network = found.file.experiment.material.kind == diagnose::MaterialKind::network;
    for (const diagnose::Measurement& table : found.file.experiment.measurements) {
        if (network && std::isnan(table.fluid_viscosity) && looks_newtonian(table)) {
            found.findings.emplace_back(
                table.label +
                ": this sample is a liquid, not a network of particles: G'' is far above G' and proportional to the frequency; "
                "add [material] with kind = \"newtonian\", and its viscosity where it is known");
        }
    }
}

/// Drops the noise of step tests without replicates: their conversion tells their errors.
void drop_assumed_noise(CheckedExperiment& found) {
    std::erase_if(found.noise, [&](const diagnose::NoiseModel& model) {
        return model.labels.size() == 1 && std::any_of(found.conversions.begin(), found.conversions.end(), [&](const auto& one) {
                   return found.file.experiment.measurements[one.measurement].label == model.labels.front();
               });
    });
}

}  // namespace

CheckedExperiment check_experiment(const std::string& path, diagnose::DiagnosisOptions options) {
    CheckedExperiment found{.file = read_experiment(path), .options = std::move(options)};
    diagnose::Experiment& experiment = found.file.experiment;
    const diagnose::StatedNoise& noise = found.file.noise;
    found.tables = check_tables(found.file);
    std::transform(found.tables.begin(), found.tables.end(), experiment.measurements.begin(),
                   [](const diagnose::CheckedMeasurement& checked) { return checked.measurement; });
    found.conversions = diagnose::convert_step_tests(experiment);
    diagnose::ErrorSpec& errors = found.options.errors;
    errors.tables.resize(experiment.measurements.size());
    for (const diagnose::StepConversion& conversion : found.conversions) {
        errors.tables[conversion.measurement] = conversion.errors;
        found.findings.emplace_back(conversion);
    }
    note_liquids(found);
    note_set_stresses(found);
    const auto add = [&](const auto& facts) { found.findings.insert(found.findings.end(), facts.begin(), facts.end()); };
    add(diagnose::leave_out_outliers(experiment.measurements));
    state_inherited(experiment);
    add(diagnose::lone_tables(experiment.measurements));
    add(diagnose::groups_of_replicates(experiment.measurements));
    found.noise = diagnose::noise_of_tables(experiment.measurements, noise);
    drop_assumed_noise(found);
    found.options.stated_noise = noise;
    errors = diagnose::estimated_errors(experiment, found.noise, noise, std::move(errors));
    diagnose::reduce_waveforms(experiment, errors, noise.relative, noise.phase);
    naming(path, [&] {
        add(diagnose::doubtful_clocks(experiment));
        found.structures = check_structures(experiment);
        if (experiment.structure_sizes.empty() && experiment.material.kind == diagnose::MaterialKind::network) {
            found.findings.emplace_back("the experiment names no structures yet, which a diagnosis needs");
        } else {
            diagnose::check(experiment, found.options);
        }
    });
    return found;
}

}  // namespace coagula::experiment
