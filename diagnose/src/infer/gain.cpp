// SPDX-License-Identifier: GPL-3.0-or-later
#include "gain.hpp"

#include "data/table_cells.hpp"
#include "departures.hpp"
#include "flexible.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>

namespace coagula::diagnose {

namespace {

constexpr std::size_t block_rows = 3;
constexpr int resamples = 2000;
constexpr std::ptrdiff_t fewest_known = 4;
constexpr std::size_t most_folds = 3;
constexpr Index draws = 32;  ///< from the posterior of a fit

std::vector<Index> rows_where(const std::vector<bool>& held_out, bool wanted) {
    std::vector<Index> rows;
    for (std::size_t k = 0; k < held_out.size(); ++k) {
        if (held_out[k] == wanted) {
            rows.push_back(static_cast<Index>(k));
        }
    }
    return rows;
}

Prediction rows_of(const Prediction& all, const std::vector<Index>& rows) {
    ModelErrors errors = all.errors;
    errors.changes = all.errors.changes(rows, Eigen::all);
    return {all.values(rows), all.level_slope(rows), std::move(errors)};
}

/// Predicts every row about the errors that the known rows alone make most probable.
Prediction predicted(const Forward& everywhere, const Inference& known, const Model& model) {
    return everywhere.is_nonlinear(model) ? everywhere.prediction(model, known.prediction(model).errors.linearised_at)
                                          : everywhere.prediction(model);
}

/// Sum of the squares of the relative differences. |G*| of a row is what both of its moduli are compared with.
double squares(const DataSet& held, const Eigen::VectorXd& prediction) {
    const Eigen::ArrayXd sizes = complex_moduli(held.observations, held.values);
    double sum = 0;
    for (Index k = 0; k < held.size(); ++k) {
        const Observation& one = held.observations[static_cast<std::size_t>(k)];
        const double level = is_modulus_or_viscosity(one) ? sizes[k] : relative_to(one, one.value);
        sum += std::pow((one.value - prediction[k]) / std::max(level, 1e-300), 2);
    }
    return sum;
}

/// Log predictive density of each block of held-out neighbours, given the rest.
std::vector<double> log_densities(const DataSet& data, const std::vector<Index>& known, const std::vector<Index>& held,
                                  const Forward& everywhere, const Inference& by_known, const Fit& fit) {
    std::vector<Prediction> predictions;
    std::vector<double> before;  // of the rest
    for (const Model& model : fit.drawn(draws)) {
        predictions.push_back(predicted(everywhere, by_known, model));
        before.push_back(by_known.errors().log_density(rows_of(predictions.back(), known)));
    }
    std::vector<double> densities;
    for (std::size_t first = 0; first < held.size(); first += block_rows) {
        std::vector<Index> rows = known;
        rows.insert(rows.end(), held.begin() + static_cast<std::ptrdiff_t>(first),
                    held.begin() + static_cast<std::ptrdiff_t>(std::min(held.size(), first + block_rows)));
        const auto added = static_cast<double>(rows.size() - known.size());
        std::sort(rows.begin(), rows.end());
        const DataSet more = data.part(rows);
        const ErrorModel with_block(more);
        std::vector<double> logarithms;
        for (std::size_t draw = 0; draw < predictions.size(); ++draw) {
            logarithms.push_back(with_block.log_density(rows_of(predictions[draw], rows)) - before[draw]);
        }
        densities.push_back(log_mean(logarithms) - 0.5 * added * std::log(2 * std::numbers::pi));
    }
    return densities;
}

/// The most probable of all, on the data of this inference alone.
Fit chosen(const Inference& inference, const Fit& base, const Hypothesis& possible, const DiagnosisOptions& options) {
    DiagnosisOptions quick = options;
    quick.bootstrap = std::min(quick.bootstrap, 199);
    const Priors priors = priors_of(options, possible.size());
    const Comparison comparison = compare(base, possible, inference, quick, Effort::brief);
    const Compared& winner = comparison.all[comparison.winner];
    return winner.log_total(priors) > comparison.all.front().log_weight() ? winner.fit : base;
}

/// 90 % interval of the sum of differences: folds are drawn again, and in each blocks of neighbours; one block says nothing of the
/// scatter of blocks.
void bootstrap_interval(const std::vector<std::vector<double>>& differences, std::uint64_t seed, Gain& gain) {
    std::size_t blocks = 0;
    for (const std::vector<double>& fold : differences) {
        blocks += fold.size();
    }
    if (blocks < 2) {
        return;
    }
    std::vector<double> sums(resamples, 0.0);
    for (std::size_t sample = 0; sample < sums.size(); ++sample) {
        std::uint64_t drawn = 0;
        const auto place_in = [&](std::size_t count) {
            const double place = random_uniform(seed, RandomPurpose::diagnosis, 1000000 + sample, drawn++)[0];
            return static_cast<std::size_t>(place * static_cast<double>(count));
        };
        for (std::size_t k = 0; k < differences.size(); ++k) {
            const std::vector<double>& fold = differences[place_in(differences.size())];
            for (std::size_t block = 0; block < fold.size(); ++block) {
                sums[sample] += fold[place_in(fold.size())];
            }
        }
    }
    std::sort(sums.begin(), sums.end());
    gain.elpd_low = sums[resamples / 20];
    gain.elpd_high = sums[resamples - resamples / 20 - 1];
}

/// Rows of these in turn, some together if they are many.
std::vector<std::vector<bool>> folds_of(const std::vector<std::vector<bool>>& parts) {
    std::vector<std::vector<bool>> folds(parts.begin(),
                                         parts.begin() + static_cast<std::ptrdiff_t>(std::min(parts.size(), most_folds)));
    for (std::size_t part = folds.size(); part < parts.size(); ++part) {
        std::vector<bool>& fold = folds[part % most_folds];
        std::transform(fold.begin(), fold.end(), parts[part].begin(), fold.begin(), std::logical_or<>());
    }
    return folds;
}

/// The rows of each sample, or each table, of which everything was measured in the same way elsewhere, too: without the others
/// nothing could be known of what they show.
/// @param name of what a table belongs to.
template <class Name>
std::vector<std::vector<bool>> repeated_parts(const Experiment& experiment, const std::vector<Observation>& observations,
                                              const Name& name) {
    const auto repeated = [&](std::size_t table) {
        return std::any_of(observations.begin(), observations.end(), [&](const Observation& one) {
            const Measurement& other = experiment.measurements[one.measurement];
            const Measurement& own = experiment.measurements[table];
            return name(one.measurement) != name(table) && other.kind == own.kind && measured_alike(other, own);
        });
    };
    std::map<decltype(name(std::size_t{})), std::vector<bool>> parts;
    std::set<decltype(name(std::size_t{}))> alone;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const std::size_t table = observations[k].measurement;
        parts.try_emplace(name(table), observations.size(), false).first->second[k] = true;
        if (!repeated(table)) {
            alone.insert(name(table));
        }
    }
    std::vector<std::vector<bool>> all;
    for (auto& [own, rows] : parts) {
        if (!alone.contains(own)) {
            all.push_back(std::move(rows));
        }
    }
    return all;
}

/// The end of the axis of every table.
std::vector<bool> ends_of_tables(const Experiment& experiment, const std::vector<Observation>& observations, double part) {
    std::vector<bool> held;
    for (const Observation& one : observations) {
        const auto rows = static_cast<double>(experiment.measurements[one.measurement].rows());
        held.push_back(one.row >= static_cast<std::size_t>(std::ceil((1 - part) * rows)));
    }
    return held;
}

}  // namespace

DataSet with_errors_of_the_rest(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment,
                                const Eigen::VectorXd& structure_deviation, const DiagnosisOptions& options) {
    const std::vector<TableErrors>& errors = options.errors.tables;
    if (std::none_of(errors.begin(), errors.end(),
                     [](const TableErrors& one) { return one.source == ErrorSource::noise && !one.columns.empty(); })) {
        return data;
    }
    Experiment rest = experiment;
    std::vector<Observation> lost;
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        if (held_out[k] && is_modulus_or_viscosity(data.observations[k])) {
            lost.push_back(data.observations[k]);
        }
    }
    put_values(lost, Eigen::VectorXd::Constant(static_cast<Index>(lost.size()), unset), rest);
    const std::vector<NoiseModel> noise = noise_of_tables(rest.measurements, options.stated_noise);
    DataSet found = data_set_of(experiment, estimated_errors(experiment, noise, options.stated_noise, options.errors));
    found.noise.widen(structure_deviation);
    return found;
}

std::vector<std::vector<bool>> choose_folds(const Experiment& experiment, const std::vector<Observation>& observations,
                                            double part) {
    std::vector<std::vector<bool>> folds = folds_of(
        repeated_parts(experiment, observations, [&](std::size_t table) { return experiment.measurements[table].sample; }));
    if (folds.size() < 2) {
        folds = folds_of(repeated_parts(experiment, observations, [](std::size_t table) { return table; }));
    }
    if (folds.size() < 2) {
        folds = {ends_of_tables(experiment, observations, part)};
    }
    std::erase_if(folds, [](const std::vector<bool>& held) {
        return std::count(held.begin(), held.end(), false) < fewest_known || std::count(held.begin(), held.end(), true) == 0;
    });
    return folds;
}

namespace {

/// A fold says this of the gain.
struct FoldGain {
    std::vector<HeldOutPrediction> predictions;
    double base_squares = 0;  ///< of the differences, relative
    double extended_squares = 0;
    double flexible_squares = 0;
    std::vector<double> differences;  ///< of the log predictive density, of each block
    CauseSet chosen;
};

FoldGain gain_of_fold(const DataSet& all, const std::vector<bool>& held_out, const Forward& everywhere,
                      const SmoothDepartures& departures, const Hypothesis& possible, const DiagnosisOptions& options) {
    const Experiment& experiment = everywhere.experiment();
    DataSet data = with_errors_of_the_rest(all, held_out, experiment, everywhere.structure_deviation(all.values), options);
    const std::vector<Index> known_rows = rows_where(held_out, false);
    const std::vector<Index> held_rows = rows_where(held_out, true);
    DataSet known = data.part(known_rows);
    const Forward forward(experiment, known.observations, everywhere.simulator());
    const RowCorrelations correlations = correlations_by_base(forward, known);
    set_correlations(correlations, known);
    set_correlations(correlations, data);
    const DataSet held = data.part(held_rows);
    const ErrorModel errors(known);
    const Inference inference(forward, errors);
    const Fit base = inference.fit({});
    const Fit extended = chosen(inference, base, possible, options);
    const auto predicted_by = [&](const Model& model) {
        const Prediction all_rows = predicted(everywhere, inference, model);
        return shown(all_rows, errors.effects(rows_of(all_rows, known_rows)).tail(all_rows.errors.linearised_at.size()));
    };
    const Eigen::VectorXd by_base = predicted_by(base.model);
    const Eigen::VectorXd better = predicted_by(extended.model);
    const Eigen::VectorXd flexible = flexible_prediction(data, by_base, known_rows, departures);
    FoldGain gain{.predictions = {},
                  .base_squares = squares(held, by_base(held_rows)),
                  .extended_squares = squares(held, better(held_rows)),
                  .flexible_squares = squares(held, flexible(held_rows)),
                  .differences = log_densities(data, known_rows, held_rows, everywhere, inference, extended),
                  .chosen = extended.hypothesis};
    for (const Index row : held_rows) {
        gain.predictions.push_back({static_cast<std::size_t>(row), by_base[row], better[row], flexible[row]});
    }
    const std::vector<double> of_base = log_densities(data, known_rows, held_rows, everywhere, inference, base);
    std::transform(gain.differences.begin(), gain.differences.end(), of_base.begin(), gain.differences.begin(), std::minus<>());
    return gain;
}

}  // namespace

Gain measure_gain(const DataSet& all, const std::vector<std::vector<bool>>& folds, const Experiment& experiment,
                  Simulator& simulator, const Hypothesis& possible, const DiagnosisOptions& options) {
    Gain gain;
    if (folds.empty()) {
        return gain;
    }
    const Forward everywhere(experiment, all.observations, simulator);
    const SmoothDepartures departures = smooth_departures(all.observations);
    std::vector<FoldGain> gains(folds.size());
    simulator.together(folds.size(), [&](std::size_t k) {
        // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): it remembers its last material
        const Forward own(everywhere);
        gains[k] = gain_of_fold(all, folds[k], own, departures, possible, options);
    });
    FoldGain sum;
    std::vector<std::vector<double>> differences;
    for (FoldGain& one : gains) {
        gain.predictions.insert(gain.predictions.end(), one.predictions.begin(), one.predictions.end());
        gain.chosen.push_back(std::move(one.chosen));
        sum.base_squares += one.base_squares;
        sum.extended_squares += one.extended_squares;
        sum.flexible_squares += one.flexible_squares;
        for (const double difference : one.differences) {
            gain.elpd_difference = (std::isnan(gain.elpd_difference) ? 0.0 : gain.elpd_difference) + difference;
        }
        differences.push_back(std::move(one.differences));
    }
    gain.held_out = gain.predictions.size();
    const auto count = static_cast<double>(gain.held_out);
    gain.rmse_base = std::sqrt(sum.base_squares / count);
    gain.rmse_extended = std::sqrt(sum.extended_squares / count);
    gain.rmse_flexible = std::sqrt(sum.flexible_squares / count);
    gain.rmse_ratio = gain.rmse_extended > 0 ? gain.rmse_base / gain.rmse_extended : 1.0;
    bootstrap_interval(differences, options.seed, gain);
    return gain;
}

}  // namespace coagula::diagnose
