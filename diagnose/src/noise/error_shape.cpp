// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/noise.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace coagula::diagnose {

namespace {

/// Factor on a deviation of correlated rows about their mean, which takes more from them than from independent ones.
double lost_to_effects(double correlation, double rows) {
    const double per_mean = std::min(0.8 * rows, (1 + correlation) / (1 - correlation));  // rows in a row's place
    return std::sqrt((1 - 1 / rows) / (1 - per_mean / rows));
}

/// Mean and standard deviation of the correlation of neighbouring rows, which lies between 0 and 0.9.
struct Correlation {
    double mean = 0;
    double deviation = 0;
};

/// Beforehand all are equally probable. @param estimate by replicates. @param error its standard error at no correlation;
/// infinite: there is no estimate.
Correlation correlation_by(double estimate, double error) {
    constexpr double strongest = 0.9;
    constexpr int nodes = 180;
    double sum = 0;
    double first = 0;
    double second = 0;
    for (int node = 0; node < nodes; ++node) {
        const double place = strongest * (node + 0.5) / nodes;
        const double deviation = error * std::sqrt(1 - place * place);
        const double likelihood =
            std::isfinite(error) ? std::exp(-0.5 * std::pow((estimate - place) / deviation, 2)) / deviation : 1.0;
        const double weight = std::max(likelihood, 1e-300);
        sum += weight;
        first += weight * place;
        second += weight * place * place;
    }
    const double mean = first / sum;
    return {mean, std::sqrt(std::max(0.0, second / sum - mean * mean))};
}

/// What the replicates of all tables show, weighted by their values.
struct Pooled {
    double values = 0;
    double degrees = 0;
    double lag = 0;
    double bias = 0;  ///< of that by the sample effects
    double kurtosis = 0;
    double variance = 0;  ///< relative
};

Pooled pool(const std::vector<NoiseModel>& models, bool of_phase) {
    Pooled all;
    for (const NoiseModel& other : models) {
        if (other.rows_estimated && is_of_phase(other) == of_phase && other.conditions > 1) {
            const auto weight = static_cast<double>(other.values);
            all.values += weight;
            all.degrees += other.degrees;
            all.variance += other.degrees * other.relative.value * other.relative.value;
            all.lag += weight * other.autocorrelation;
            all.bias += other.sample_estimated ? weight / static_cast<double>(other.conditions) : 0.0;
            all.kurtosis += weight * other.excess_kurtosis;
        }
    }
    return all;
}

/// Few replicates say little about their scatter: it is drawn towards that of the other tables (Smyth 2004).
void draw_towards_others(const NoiseModel& model, const Pooled& all, ErrorShape& shape) {
    constexpr double prior_degrees = 20;
    const double borrowed = std::min(prior_degrees, all.degrees - model.degrees);
    const double own = model.relative.value * model.relative.value;
    if (model.rows_estimated && borrowed > 0 && model.floor.value == 0 && own > 0) {
        shape.law.degrees += borrowed;
        shape.factor = std::sqrt((model.degrees * own + borrowed * all.variance / all.degrees) / shape.law.degrees / own);
    }
}

}  // namespace

ErrorShape shape_of_errors(const std::vector<NoiseModel>& models, const NoiseModel& model) {
    const Pooled all = pool(models, is_of_phase(model));
    ErrorShape shape;
    shape.law.degrees = model.degrees;
    if (all.values > 0) {
        draw_towards_others(model, all, shape);
    }
    // Mean of the lag-one coefficient of n rows about their mean, a sample effect: rho - (1 + 3 rho) / n (Kendall 1954).
    const double own = all.values > 0 ? all.bias / all.values : 1.0;
    const bool told = own < 0.25;
    const double unbiased = told ? (all.lag / all.values + own) / (1 - 3 * own) : 0.0;
    const double error = told ? 1 / std::sqrt(all.degrees) / (1 - 3 * own) : std::numeric_limits<double>::infinity();
    const bool stated = !told && std::isfinite(model.stated_correlation);
    const auto [correlation, deviation] = stated ? Correlation{model.stated_correlation, 0} : correlation_by(unbiased, error);
    shape.law.correlation = correlation;
    shape.law.correlation_error = deviation;
    if (model.rows_estimated) {
        shape.factor *= model.sample_estimated ? lost_to_effects(correlation, static_cast<double>(model.conditions)) : 1.0;
        // Variance of the variance of correlated numbers (Bayley and Hammersley 1946).
        shape.law.degrees *= (1 - correlation * correlation) / (1 + correlation * correlation);
    }
    if (all.values == 0) {
        return shape;
    }
    // Kurtosis of Student's t: 6 / (nu - 4). Its estimate, of a variance of 24 over the degrees of freedom, is drawn towards none.
    constexpr double prior_variance = 1;
    const double kurtosis = all.kurtosis / all.values * prior_variance / (prior_variance + 24 / all.degrees);
    if (kurtosis > 0) {
        shape.law.tail = 4 + 6 / kurtosis;
        shape.law.degrees /= 1 + 0.5 * kurtosis;  // variance of a variance
    }
    return shape;
}

}  // namespace coagula::diagnose
