#include "gain.hpp"

#include "flexible.hpp"

#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace coagula::diagnose {

namespace {

constexpr std::size_t block_rows = 3;
constexpr int resamples = 2000;
constexpr std::ptrdiff_t fewest_known = 4;

std::vector<Index> rows_where(const std::vector<bool>& held_out, bool wanted) {
    std::vector<Index> rows;
    for (std::size_t k = 0; k < held_out.size(); ++k) {
        if (held_out[k] == wanted) {
            rows.push_back(static_cast<Index>(k));
        }
    }
    return rows;
}

/// Log predictive density of every held-out number, the sample effect as an independent error.
Eigen::VectorXd log_densities(const DataSet& held, const Eigen::VectorXd& prediction) {
    const Eigen::ArrayXd variance = held.noise.deviation.array().square();
    return -0.5 * ((held.values - prediction).array().square() / variance + (2 * M_PI * variance).log()).matrix();
}

double root_mean_square(const DataSet& held, const Eigen::VectorXd& prediction) {
    // Relative to |G*| of the row, so that G'' counts by what it is worth.
    double sum = 0;
    for (std::size_t k = 0; k < held.observations.size(); ++k) {
        double level = is_modulus(held.observations[k]) ? 0.0 : relative_to(held.observations[k], held.observations[k].value);
        for (std::size_t j = 0; j < held.observations.size(); ++j) {
            if (is_modulus(held.observations[k]) && held.observations[j].measurement == held.observations[k].measurement &&
                held.observations[j].row == held.observations[k].row) {
                level = std::hypot(level, held.observations[j].value);
            }
        }
        const double difference = (held.observations[k].value - prediction[static_cast<Index>(k)]) / std::max(level, 1e-300);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(held.observations.size()));
}

/// 90 % interval of a sum of differences, resampled in blocks of neighbours; one block says nothing of the scatter of blocks.
void bootstrap_interval(const Eigen::VectorXd& differences, std::uint64_t seed, Gain& gain) {
    const auto count = static_cast<std::size_t>(differences.size());
    const std::size_t blocks = (count + block_rows - 1) / block_rows;
    if (blocks < 2) {
        return;
    }
    std::vector<double> sums(resamples, 0.0);
    for (std::size_t sample = 0; sample < sums.size(); ++sample) {
        for (std::size_t drawn = 0; drawn < blocks; ++drawn) {
            const double place = random_uniform(seed, RandomPurpose::diagnosis, 1000000 + sample, drawn)[0];
            const auto block = static_cast<std::size_t>(place * static_cast<double>(blocks));
            for (std::size_t row = block * block_rows; row < std::min(count, (block + 1) * block_rows); ++row) {
                sums[sample] += differences[static_cast<Index>(row)];
            }
        }
    }
    std::sort(sums.begin(), sums.end());
    gain.elpd_low = sums[resamples / 20];
    gain.elpd_high = sums[resamples - resamples / 20 - 1];
}

}  // namespace

std::vector<bool> choose_held_out(const Experiment& experiment, const std::vector<Observation>& observations, double part) {
    std::map<MeasurementKind, std::vector<std::size_t>> tables;
    for (const Observation& observation : observations) {
        auto& list = tables[experiment.measurements[observation.measurement].kind];
        if (std::find(list.begin(), list.end(), observation.measurement) == list.end()) {
            list.push_back(observation.measurement);
        }
    }
    std::vector<bool> held(observations.size(), false);
    for (const auto& [kind, list] : tables) {
        const auto sample_of = [&](std::size_t table) { return experiment.measurements[table].sample; };
        if (list.size() >= 2 && sample_of(list.back()) != sample_of(list.front())) {
            for (std::size_t k = 0; k < observations.size(); ++k) {
                held[k] = held[k] || observations[k].measurement == list.back();
            }
            continue;
        }
        for (const std::size_t table : list) {
            const std::size_t rows = experiment.measurements[table].rows();
            const auto kept = static_cast<std::size_t>(std::ceil((1 - part) * static_cast<double>(rows)));
            for (std::size_t k = 0; k < observations.size(); ++k) {
                held[k] = held[k] || (observations[k].measurement == table && observations[k].row >= kept);
            }
        }
    }
    const bool enough = std::count(held.begin(), held.end(), false) >= fewest_known;
    return enough ? held : std::vector<bool>(observations.size(), false);
}

Gain measure_gain(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment, Simulator& simulator,
                  const Hypothesis& extended, std::uint64_t seed) {
    const std::vector<Index> known_rows = rows_where(held_out, false);
    const std::vector<Index> held_rows = rows_where(held_out, true);
    const DataSet known = data.part(known_rows);
    const DataSet held = data.part(held_rows);
    Gain gain;
    gain.held_out = held.observations.size();
    if (held.observations.empty()) {
        return gain;
    }
    const Likelihood likelihood(known);
    const Forward forward(experiment, known.observations, simulator);
    const Forward everywhere(experiment, data.observations, simulator);
    const Inference inference(forward, likelihood);
    const auto predict = [&](const Hypothesis& hypothesis) {
        return everywhere.predict(inference.fit(hypothesis).settings, !hypothesis.empty());
    };
    const Eigen::VectorXd base = predict({});
    const Eigen::VectorXd better = predict(extended);
    const Eigen::VectorXd flexible = flexible_prediction(data, base, known_rows);
    gain.rmse_base = root_mean_square(held, base(held_rows));
    gain.rmse_extended = root_mean_square(held, better(held_rows));
    gain.rmse_flexible = root_mean_square(held, flexible(held_rows));
    gain.rmse_ratio = gain.rmse_extended > 0 ? gain.rmse_base / gain.rmse_extended : 1.0;
    for (const Index row : held_rows) {
        gain.predictions.push_back({static_cast<std::size_t>(row), base[row], better[row], flexible[row]});
    }
    const Eigen::VectorXd differences = log_densities(held, better(held_rows)) - log_densities(held, base(held_rows));
    gain.elpd_difference = differences.sum();
    bootstrap_interval(differences, seed, gain);
    return gain;
}

}  // namespace coagula::diagnose
