// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>
#include <coagula/diagnose/waveform.hpp>

#include "data/table_cells.hpp"

#include <coagula/common/special_functions.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace coagula::diagnose {

namespace {

/// b of the sample of a table; 0 where it was not estimated.
double sample_effect(const NoiseModel& model, const Measurement& table) {
    const auto found = std::find_if(model.sample_effects.begin(), model.sample_effects.end(),
                                    [&](const SampleEffect& effect) { return effect.sample == table.sample; });
    return found == model.sample_effects.end() ? 0.0 : found->effect;
}

/// |G*| of a row, or its one modulus; NaN beyond the table.
double size_of(const Measurement& table, const Column& column, std::size_t row) {
    if (row >= column.values.size()) {
        return unset;
    }
    const double size = complex_modulus(table, row);
    return std::isnan(size) ? column.values[row] : size;
}

/// The size of a row; of the first row of a frequency sweep not less than half of what the next two lead to, or the nearest. A
/// sweep that begins too early shows too small a modulus, and an error in proportion to that would give the worst row the largest
/// weight. (Elsewhere what is small by itself shows beside its neighbours; small at the end of a sweep, or before a recovery, may
/// be the material.)
double plausible_size(const Measurement& table, const Column& column, std::size_t row) {
    constexpr double far_below = 0.5;
    const double own = std::abs(size_of(table, column, row));
    if (row > 0 || table.kind != MeasurementKind::frequency_sweep) {
        return own;
    }
    const double next = std::abs(size_of(table, column, 1));
    const double second = std::abs(size_of(table, column, 2));
    const double expected = std::min(next, next * next / second);
    return std::isfinite(expected) && own < far_below * expected ? expected : own;
}

/// What is expected of this sample in this row by the replicates, so that a row's error does not depend on its own; where there are
/// none, its plausible size.
double level_at(const NoiseModel& model, const Measurement& table, const Column& column, std::size_t row) {
    const double place = axis_of(table)->values[row];
    for (Eigen::Index condition = 0; condition < model.axis.size(); ++condition) {
        if (alike(model.axis[condition], place)) {
            return model.levels[condition] * (1 + sample_effect(model, table));
        }
    }
    return plausible_size(table, column, row);
}

/// The model of a table's errors of torque or phase; null where there is none.
const NoiseModel* model_of(const std::vector<NoiseModel>& noise, const Measurement& table, bool phase) {
    const auto found = std::find_if(noise.begin(), noise.end(), [&](const NoiseModel& one) {
        return is_of_phase(one) == phase && std::find(one.labels.begin(), one.labels.end(), table.label) != one.labels.end();
    });
    return found == noise.end() ? nullptr : &*found;
}

/// Deviations of torque or phase in every row, as a modulus; zero without a model.
ColumnErrors errors_by(const NoiseModel* model, const std::vector<NoiseModel>& noise, const Measurement& table,
                       const Column& column) {
    ColumnErrors errors{column.name, std::vector<double>(column.values.size(), 0.0)};
    if (model == nullptr) {
        return errors;
    }
    const ErrorShape shape = shape_of_errors(noise, *model);
    errors.law = shape.law;
    const Column* strain = find_column(table, is_flow(table.kind) ? "shear_rate" : "strain");
    for (std::size_t row = 0; row < column.values.size(); ++row) {
        const double weight = model->floor_of_stress && strain != nullptr ? 1 / strain->values[row] : 1.0;
        errors.deviations[row] = shape.factor * standard_deviation(*model, level_at(*model, table, column, row), weight);
    }
    return errors;
}

/// Errors of one modulus from those of torque and phase, by the phase of each row.
std::vector<double> errors_of_part(const Measurement& table, const Column& column, const ColumnErrors& torque,
                                   const ColumnErrors& phase) {
    std::vector<double> errors;
    for (std::size_t row = 0; row < column.values.size(); ++row) {
        const double size = complex_modulus(table, row);
        const double along = std::isnan(size) ? 1.0 : column.values[row] / size;
        errors.push_back(
            std::hypot(along * torque.deviations[row], std::sqrt(std::max(0.0, 1 - along * along)) * phase.deviations[row]));
    }
    return errors;
}

bool is_response(const Column& column) {
    return column.name == "viscosity" || column.name == "storage_modulus" || column.name == "loss_modulus";
}

/// The columns of moduli, or of the viscosity, whose errors the table does not state.
std::vector<const Column*> open_columns(const Measurement& table) {
    std::vector<const Column*> open;
    for (const Column& column : table.columns) {
        if (is_response(column) && is_flow(table.kind) == (column.name == "viscosity") && column.standard_errors.empty()) {
            open.push_back(&column);
        }
    }
    return open;
}

/// Errors of torque and phase for the columns whose errors the table does not state.
TableErrors errors_of(const Measurement& table, const std::vector<NoiseModel>& noise) {
    const std::vector<const Column*> open = open_columns(table);
    const NoiseModel* torque = model_of(noise, table, false);
    if (torque == nullptr || open.empty()) {
        return {};
    }
    const NoiseModel* phase = model_of(noise, table, true);
    const ColumnErrors along = errors_by(torque, noise, table, *open.front());
    const ColumnErrors across = errors_by(phase, noise, table, *open.front());
    TableErrors errors{.polar = open.size() == 2 && phase != nullptr};
    for (const Column* column : open) {
        const ColumnErrors& own = errors.polar && column->name == "loss_modulus" ? across : along;
        errors.columns.push_back(
            {column->name, errors.polar ? own.deviations : errors_of_part(table, *column, along, across), own.law});
    }
    return errors;
}

/// Scatter of the levels of samples, as replicates show it.
struct Scatter {
    double degrees = 0;    ///< of freedom
    double variance = 0;   ///< mean over these
    double from_rows = 0;  ///< variance that the errors of the rows leave in the level of a sample
};

/// Models of the same samples tell the same effects.
Scatter scatter_of_samples(const std::vector<NoiseModel>& noise) {
    std::map<std::vector<std::string>, std::vector<const NoiseModel*>> of_samples;
    for (const NoiseModel& model : noise) {
        if (model.sample_estimated) {
            std::vector<std::string> names;
            for (const SampleEffect& effect : model.sample_effects) {
                names.push_back(effect.sample);
            }
            of_samples[names].push_back(&model);
        }
    }
    Scatter all;
    for (const auto& [names, models] : of_samples) {
        const auto degrees = static_cast<double>(names.size() - 1);
        const double weight = degrees / static_cast<double>(models.size());
        for (const NoiseModel* model : models) {
            const double correlation = std::clamp(model->autocorrelation, 0.0, 0.9);
            const double rows = static_cast<double>(model->conditions) * (1 - correlation) / (1 + correlation);
            all.variance += weight * model->sample.value * model->sample.value;
            all.from_rows += weight * model->relative.value * model->relative.value / rows;
        }
        all.degrees += degrees;
    }
    if (all.degrees > 0) {
        all.variance /= all.degrees;
        all.from_rows /= all.degrees;
    }
    return all;
}

/// The x at which the decreasing trigamma function has a value.
double inverse_trigamma(double value) {
    double low = 1e-3;
    double high = 1e6;
    for (int halving = 0; halving < 60; ++halving) {
        const double middle = std::sqrt(low * high);
        (trigamma(middle) > value ? low : high) = middle;
    }
    return std::sqrt(low * high);
}

/// The stated scatter is known to a factor of e (a standard deviation of its logarithm): samples that are alike show it soon. The
/// posterior of the variance is then described by the scaled inverse chi-square of the same mean and variance of its logarithm.
void estimate_sample_effect(const std::vector<NoiseModel>& noise, double stated, ErrorSpec& errors) {
    const Scatter seen = scatter_of_samples(noise);
    errors.sample = stated;
    if (seen.degrees == 0) {
        return;
    }
    if (stated == 0) {
        errors.sample = std::sqrt(seen.variance);
        errors.sample_degrees = seen.degrees;
        return;
    }
    constexpr double farthest = 8;  // logarithms of the deviation
    constexpr int nodes = 801;
    const Eigen::ArrayXd logarithm = std::log(stated) + Eigen::ArrayXd::LinSpaced(nodes, -farthest, farthest);
    const Eigen::ArrayXd variance = (2 * logarithm).exp() + seen.from_rows;
    const Eigen::ArrayXd density = -0.5 * (logarithm - std::log(stated)).square() -
                                   0.5 * seen.degrees * (variance.log() + (seen.variance + seen.from_rows) / variance);
    const Eigen::ArrayXd weight = (density - density.maxCoeff()).exp();
    const double mean = 2 * (weight * logarithm).sum() / weight.sum();
    const double spread = (weight * (2 * logarithm - mean).square()).sum() / weight.sum();
    const double half = inverse_trigamma(spread);
    errors.sample = std::exp(0.5 * (mean + digamma(half) - std::log(half)));
    errors.sample_degrees = 2 * half;
}

}  // namespace

ErrorSpec estimated_errors(const Experiment& experiment, const std::vector<NoiseModel>& noise, const StatedNoise& stated,
                           ErrorSpec known) {
    known.tables.resize(experiment.measurements.size());
    for (std::size_t table = 0; table < known.tables.size(); ++table) {
        if (known.tables[table].source == ErrorSource::noise) {
            known.tables[table] = errors_of(experiment.measurements[table], noise);
        }
    }
    estimate_sample_effect(noise, stated.sample, known);
    return known;
}

TableErrors planned_errors(const Measurement& table, const StatedNoise& noise) {
    const bool stores = std::isnan(table.fluid_viscosity) && find_column(table, "storage_modulus") != nullptr;
    TableErrors errors{.polar = stores && find_column(table, "loss_modulus") != nullptr};
    for (const Column& column : table.columns) {
        const bool harmonic = column.name.starts_with("third_harmonic");
        if (!harmonic && !is_response(column)) {
            continue;
        }
        ColumnErrors own{column.name};
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const double size = std::abs(errors.polar && !harmonic ? complex_modulus(table, row) : column.values[row]);
            const double strain = cell(table, "strain", row);
            const double torque = std::hypot(std::isfinite(strain) ? noise.floor / strain : noise.floor, noise.relative * size);
            own.deviations.push_back(harmonic ? std::hypot(unstated_harmonic_error, third_harmonic_error * size)
                                     : errors.polar && column.name == "loss_modulus" ? noise.phase * size
                                                                                     : torque);
        }
        errors.columns.push_back(std::move(own));
    }
    return errors;
}

}  // namespace coagula::diagnose
