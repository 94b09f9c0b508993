// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>

#include "quasi_newton.hpp"
#include "restricted_likelihood.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr int passes = 4;
/// 95 % point of chi-square with one degree of freedom.
constexpr double chi_square_95 = 3.841458820694124;
/// Largest over smallest ratio of level to w below which floor and relative part cannot be told apart, and the floor is left out.
constexpr double least_range = 3;

/// Conditions with at least two values; the others say nothing about noise.
ReplicatedValues replicated_values(const Replicates& replicates, std::vector<std::string>& sample_names) {
    ReplicatedValues data;
    std::vector<double> values;
    std::vector<double> weights;
    for (Eigen::Index row = 0; row < replicates.values.rows(); ++row) {
        if (replicates.values.row(row).array().isFinite().count() < 2) {
            continue;
        }
        for (Eigen::Index table = 0; table < replicates.values.cols(); ++table) {
            if (!std::isfinite(replicates.values(row, table))) {
                continue;
            }
            const std::string& name = replicates.samples[static_cast<std::size_t>(table)];
            auto place = std::find(sample_names.begin(), sample_names.end(), name);
            place = place == sample_names.end() ? sample_names.insert(place, name) : place;
            values.push_back(replicates.values(row, table));
            data.condition.push_back(data.conditions);
            data.sample.push_back(place - sample_names.begin());
        }
        weights.push_back(replicates.floor_weights[row]);
        ++data.conditions;
    }
    data.floor_weights = Eigen::VectorXd::Map(weights.data(), static_cast<Eigen::Index>(weights.size()));
    data.values = Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
    data.samples = static_cast<Eigen::Index>(sample_names.size());
    return data;
}

Eigen::VectorXd mean_levels(const ReplicatedValues& data) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(data.conditions);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(data.conditions);
    for (std::size_t i = 0; i < data.condition.size(); ++i) {
        sum[data.condition[i]] += data.values[static_cast<Eigen::Index>(i)];
        count[data.condition[i]] += 1;
    }
    return sum.cwiseQuotient(count);
}

/// The likelihood as a function of those deviations that are estimated. They are taken in units of `scale`, and their sign does not
/// matter, so that zero is an inner point.
class NoiseLikelihood {
public:
    NoiseLikelihood(const ReplicatedValues& data, Eigen::VectorXd levels, Eigen::VectorXd effects, bool with_floor,
                    bool with_sample)
        : data_(data),
          levels_(std::move(levels)),
          effects_(std::move(effects)),
          scale_{std::exp((levels_.array() / data.floor_weights.array()).abs().log().mean()), 1, 1},
          free_{with_floor, true, with_sample} {}

    /// Minus the log likelihood.
    double at(const Deviations& scaled) const {
        return restricted_fit(data_, levels_, effects_, in_units(scaled)).minus_log_likelihood;
    }

    /// The maximum with one deviation held (`held` = 0, 1, 2) or none (-1).
    Deviations best(Deviations start, int held) const {
        for (std::size_t i = 0; i < 3; ++i) {
            start[i] = free_[i] || static_cast<int>(i) == held ? start[i] : 0;
        }
        const auto function = [&](const Deviations& trial) {
            Deviations used = start;
            for (std::size_t i = 0; i < 3; ++i) {
                used[i] = moves(i, held) ? trial[i] : start[i];
            }
            return at(used);
        };
        Deviations steps{};
        for (std::size_t i = 0; i < 3; ++i) {
            steps[i] = 0.3 * std::abs(start[i]) + 1e-3;
        }
        Deviations found = minimum_of(function, start, steps);
        for (std::size_t i = 0; i < 3; ++i) {
            found[i] = moves(i, held) ? std::abs(found[i]) : start[i];
        }
        return found;
    }

    Deviations in_units(Deviations scaled) const {
        for (std::size_t i = 0; i < 3; ++i) {
            scaled[i] *= scale_[i];
        }
        return scaled;
    }

    bool is_free(std::size_t i) const { return free_[i]; }
    RestrictedFit fit(const Deviations& scaled) const { return restricted_fit(data_, levels_, effects_, in_units(scaled)); }

private:
    bool moves(std::size_t i, int held) const { return free_[i] && static_cast<int>(i) != held; }

    const ReplicatedValues& data_;
    Eigen::VectorXd levels_;
    Eigen::VectorXd effects_;
    Deviations scale_;
    std::array<bool, 3> free_;
};

/// Twice the loss of log likelihood when one deviation is held at `value`.
double deviance(const NoiseLikelihood& likelihood, const Deviations& best, std::size_t which, double value) {
    Deviations start = best;
    start[which] = value;
    return 2 * (likelihood.at(likelihood.best(start, static_cast<int>(which))) - likelihood.at(best));
}

/// Where the deviance reaches the 95 % point between `inside` and `outside`.
double crossing(const NoiseLikelihood& likelihood, const Deviations& best, std::size_t which, double inside, double outside) {
    constexpr int halvings = 14;  // to 1e-4 of the interval
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (inside + outside);
        (deviance(likelihood, best, which, middle) < chi_square_95 ? inside : outside) = middle;
    }
    return 0.5 * (inside + outside);
}

Estimate profile(const NoiseLikelihood& likelihood, const Deviations& best, std::size_t which) {
    const double unit = likelihood.in_units({1, 1, 1})[which];
    Estimate estimate{best[which] * unit, 0, 0};
    constexpr double indistinct = 1e-4;  // loss of likelihood below which a deviation is as good as zero
    const double at_zero = deviance(likelihood, best, which, 0);
    if (at_zero < indistinct) {
        estimate.value = 0;
    }
    if (at_zero > chi_square_95) {
        estimate.low = crossing(likelihood, best, which, best[which], 0) * unit;
    }
    double outside = 1.5 * best[which] + 1e-3;
    constexpr double far = 1e4;
    while (outside < far && deviance(likelihood, best, which, outside) < chi_square_95) {
        outside *= 2;
    }
    estimate.high = crossing(likelihood, best, which, best[which], outside) * unit;
    return estimate;
}

/// A first guess: scatter of the sample means, and what is left of the values without them.
Deviations first_guess(const ReplicatedValues& data, const Eigen::VectorXd& levels) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(data.samples);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(data.samples);
    const auto relative = [&](std::size_t i) { return data.values[static_cast<Eigen::Index>(i)] / levels[data.condition[i]] - 1; };
    for (std::size_t i = 0; i < data.condition.size(); ++i) {
        mean[data.sample[i]] += relative(i);
        count[data.sample[i]] += 1;
    }
    mean = mean.cwiseQuotient(count);
    double rest = 0;
    for (std::size_t i = 0; i < data.condition.size(); ++i) {
        rest += std::pow(relative(i) - mean[data.sample[i]], 2);
    }
    const double row = std::sqrt(rest / static_cast<double>(data.condition.size())) + 1e-6;
    const double sample = std::sqrt(mean.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, data.samples - 1)));
    return {0.5 * row, row, sample + 1e-6};
}

Deviations best_of_starts(const NoiseLikelihood& likelihood, const Deviations& guess) {
    Deviations best = likelihood.best(guess, -1);
    for (const Deviations& factors : {Deviations{0.05, 1, 1}, Deviations{2, 0.05, 1}, Deviations{0.2, 0.5, 0.1}}) {
        const Deviations found = likelihood.best({guess[0] * factors[0], guess[1] * factors[1], guess[2] * factors[2]}, -1);
        best = likelihood.at(found) < likelihood.at(best) ? found : best;
    }
    return best;
}

/// Residuals over their standard deviation, a column per table; NaN where there is no value.
std::vector<Eigen::VectorXd> standardised_residuals(const Replicates& replicates, const ReplicatedValues& data,
                                                    const RestrictedFit& fit, const NoiseModel& noise) {
    std::vector<Eigen::VectorXd> rows;
    std::size_t i = 0;
    for (Eigen::Index row = 0; row < replicates.values.rows(); ++row) {
        if (replicates.values.row(row).array().isFinite().count() < 2) {
            continue;
        }
        rows.emplace_back(Eigen::VectorXd::Constant(replicates.values.cols(), std::nan("")));
        for (Eigen::Index table = 0; table < replicates.values.cols(); ++table) {
            if (std::isfinite(replicates.values(row, table))) {
                const double expected = fit.levels[data.condition[i]] * (1 + fit.effects[data.sample[i]]);
                const double level = is_of_phase(noise) ? replicates.levels[row] : expected;
                rows.back()[table] =
                    (replicates.values(row, table) - expected) / standard_deviation(noise, level, replicates.floor_weights[row]);
                ++i;
            }
        }
    }
    return rows;
}

/// Correlation of residuals that follow each other within a table.
double lag_one(const std::vector<Eigen::VectorXd>& rows) {
    double product = 0;
    double square = 0;
    for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
        for (Eigen::Index table = 0; table < rows[k].size(); ++table) {
            const double here = rows[k][table];
            const double next = rows[k + 1][table];
            if (std::isfinite(here) && std::isfinite(next)) {
                product += here * next;
                square += 0.5 * (here * here + next * next);
            }
        }
    }
    return square > 0 ? product / square : 0;
}

/// Fourth moment of a single error over that of a normal one, less 3. A residual is a difference from a mean of `tables`, which
/// dilutes it.
double excess_kurtosis(const std::vector<Eigen::VectorXd>& rows, double tables) {
    double squares = 0;
    double fourth = 0;
    double count = 0;
    for (const Eigen::VectorXd& row : rows) {
        for (const double residual : row) {
            if (std::isfinite(residual)) {
                squares += residual * residual;
                fourth += std::pow(residual, 4);
                ++count;
            }
        }
    }
    const double own = (tables - 1) / tables;
    const double dilution = (std::pow(own, 4) + (tables - 1) / std::pow(tables, 4)) / (own * own);
    return squares > 0 ? (fourth * count / (squares * squares) - 3) / dilution : 0;
}

Estimate stated(double value) {
    return {value, value, value};
}

/// Selects the values of the conditions that have replicates.
Eigen::VectorXd where_replicated(const Replicates& replicates, const Eigen::VectorXd& all) {
    std::vector<double> chosen;
    for (Eigen::Index row = 0; row < replicates.values.rows(); ++row) {
        if (replicates.values.row(row).array().isFinite().count() >= 2) {
            chosen.push_back(row < all.size() ? all[row] : std::nan(""));
        }
    }
    return Eigen::VectorXd::Map(chosen.data(), static_cast<Eigen::Index>(chosen.size()));
}

/// What was fitted to the values beforehand has made their scatter smaller.
void take_off_fitted(NoiseModel& noise, int fitted) {
    if (fitted == 0) {
        return;
    }
    const double left = std::max(noise.degrees - fitted, 1.0);
    const double factor = std::sqrt(noise.degrees / left);
    for (Estimate* estimate : {&noise.floor, &noise.relative}) {
        *estimate = {factor * estimate->value, factor * estimate->low, factor * estimate->high};
    }
    noise.degrees = left;
}

void fit_replicates(NoiseModel& noise, const Replicates& replicates, const ReplicatedValues& data,
                    const std::vector<std::string>& names, const StatedNoise& given) {
    const bool of_phase = is_of_phase(noise);
    Eigen::VectorXd levels = of_phase ? where_replicated(replicates, replicates.levels) : mean_levels(data);
    const Eigen::VectorXd sizes = levels.cwiseQuotient(data.floor_weights).cwiseAbs();
    const bool with_floor = sizes.maxCoeff() >= least_range * sizes.minCoeff();
    const bool with_sample = data.samples > 1 && !of_phase;
    Eigen::VectorXd effects = Eigen::VectorXd::Zero(data.samples);
    Deviations best = first_guess(data, levels);
    for (int pass = 0; pass < passes; ++pass) {
        const NoiseLikelihood likelihood(data, levels, effects, with_floor, with_sample);
        best = pass == 0 ? best_of_starts(likelihood, best) : likelihood.best(best, -1);
        if (pass + 1 < passes) {
            if (!of_phase) {
                const RestrictedFit fit = likelihood.fit(best);
                levels = fit.levels;
                effects = fit.effects;
            }
            continue;
        }
        noise.floor = with_floor ? profile(likelihood, best, 0) : Estimate{};
        noise.relative = profile(likelihood, best, 1);
        noise.sample = with_sample ? profile(likelihood, best, 2) : stated(of_phase ? 0 : given.sample);
        const RestrictedFit fit = likelihood.fit(best);
        for (std::size_t s = 0; with_sample && s < names.size(); ++s) {
            noise.sample_effects.push_back({names[s], fit.effects[static_cast<Eigen::Index>(s)]});
        }
        noise.levels = of_phase ? levels : fit.levels;
        const std::vector<Eigen::VectorXd> residuals = standardised_residuals(replicates, data, fit, noise);
        noise.autocorrelation = lag_one(residuals);
        noise.excess_kurtosis =
            excess_kurtosis(residuals, static_cast<double>(noise.values) / static_cast<double>(data.conditions));
        noise.axis = where_replicated(replicates, replicates.axis);
        noise.conditions = static_cast<std::size_t>(data.conditions);
        noise.degrees = static_cast<double>(noise.values) - static_cast<double>(data.conditions) -
                        static_cast<double>(with_sample ? names.size() - 1 : 0);
        take_off_fitted(noise, replicates.fitted);
    }
    noise.rows_estimated = true;
    noise.sample_estimated = with_sample;
    noise.floor_is_told = with_floor;
}

}  // namespace

NoiseModel fit_noise(const Replicates& replicates, const StatedNoise& given) {
    require(replicates.samples.size() == static_cast<std::size_t>(replicates.values.cols()),
            "replicates: one sample name per table is needed");
    require(replicates.axis.size() == replicates.values.rows(), "replicates: one axis value per row is needed");
    require(replicates.floor_weights.size() == replicates.values.rows(), "replicates: one floor weight per row is needed");
    NoiseModel noise;
    noise.floor_of_stress = replicates.floor_of_stress;
    noise.kind = replicates.kind;
    noise.labels = replicates.labels;
    noise.observable = replicates.observable;
    noise.unit = replicates.unit;
    std::vector<std::string> names;
    const ReplicatedValues data = replicated_values(replicates, names);
    noise.tables = replicates.samples.size();
    noise.samples = std::max<std::size_t>(1, names.size());
    noise.values = static_cast<std::size_t>(data.values.size());
    constexpr Eigen::Index fewest_conditions = 3;
    const bool enough = data.conditions >= fewest_conditions;
    if (enough && (is_of_phase(noise) || (mean_levels(data).array() > 0).all())) {
        fit_replicates(noise, replicates, data, names, given);
        return noise;
    }
    noise.floor = stated(given.floor);
    noise.stated_correlation = given.correlation;
    noise.relative = stated(is_of_phase(noise) ? given.phase : given.relative);
    noise.sample = stated(is_of_phase(noise) ? 0 : given.sample);
    noise.averages_to_zero = enough;
    return noise;
}

double standard_deviation(const NoiseModel& noise, double level, double floor_weight) {
    return std::hypot(noise.floor.value * floor_weight, noise.relative.value * level);
}

}  // namespace coagula::diagnose
