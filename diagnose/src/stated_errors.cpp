#include <coagula/diagnose/stated_errors.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace coagula::diagnose {

namespace {

/// b of the sample of a table; 0 where it was not estimated.
double sample_effect(const NoiseModel& model, const Measurement& table) {
    const auto found = std::find_if(model.sample_effects.begin(), model.sample_effects.end(),
                                    [&](const SampleEffect& effect) { return effect.sample == table.sample; });
    return found == model.sample_effects.end() ? 0.0 : found->effect;
}

/// What is expected of this sample in this row by the replicates, so that a row's error does not depend on its own; its value where
/// there are none.
double level_at(const NoiseModel& model, const Measurement& table, const Column& column, std::size_t row) {
    const double place = axis_of(table)->values[row];
    for (Eigen::Index condition = 0; condition < model.axis.size(); ++condition) {
        if (alike(model.axis[condition], place)) {
            return model.levels[condition] * (1 + sample_effect(model, table));
        }
    }
    return column.values[row];
}

}  // namespace

void state_sample_effect(const std::vector<NoiseModel>& noise, double stated, NoiseSettings& settings) {
    std::map<std::vector<std::string>, std::vector<double>> variances;
    for (const NoiseModel& model : noise) {
        if (model.sample_estimated) {
            std::vector<std::string> names;
            for (const SampleEffect& effect : model.sample_effects) {
                names.push_back(effect.sample);
            }
            variances[names].push_back(model.sample.value * model.sample.value);
        }
    }
    double squares = stated * stated;
    double degrees = 1;
    for (const auto& [names, each] : variances) {
        const auto own = static_cast<double>(names.size() - 1);
        squares += own * std::accumulate(each.begin(), each.end(), 0.0) / static_cast<double>(each.size());
        degrees += own;
    }
    settings.sample = std::sqrt(squares / degrees);
    settings.sample_degrees = variances.empty() ? settings.sample_degrees : degrees;
}

void state_errors(Experiment& experiment, const std::vector<NoiseModel>& noise) {
    for (Measurement& table : experiment.measurements) {
        for (Column& column : table.columns) {
            const auto model = std::find_if(noise.begin(), noise.end(), [&](const NoiseModel& one) {
                return one.observable == column.name &&
                       std::find(one.labels.begin(), one.labels.end(), table.label) != one.labels.end();
            });
            if (model == noise.end() || !column.standard_errors.empty()) {
                continue;
            }
            const ErrorShape shape = shape_of_errors(noise, *model);
            column.errors = shape.law;
            const Column* strain = find_column(table, "strain");
            for (std::size_t row = 0; row < column.values.size(); ++row) {
                const double weight = model->floor_of_stress && strain != nullptr ? 1 / strain->values[row] : 1.0;
                const double level =
                    model->relative_to_complex_modulus ? complex_modulus(table, row) : level_at(*model, table, column, row);
                const double size = complex_modulus(table, row);
                const double turned = model->phase * (std::isnan(size) ? column.values[row] : size);
                column.standard_errors.push_back(std::hypot(shape.factor * standard_deviation(*model, level, weight), turned));
            }
        }
    }
}

}  // namespace coagula::diagnose
