#include <coagula/diagnose/noise.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::diagnose {

namespace {

/// Factor on a deviation of correlated rows about their mean, which takes more from them than from independent ones.
double lost_to_effects(double correlation, double rows) {
    const double per_mean = std::min(0.8 * rows, (1 + correlation) / (1 - correlation));  // rows in a row's place
    return std::sqrt((1 - 1 / rows) / (1 - per_mean / rows));
}

}  // namespace

ErrorShape shape_of_errors(const std::vector<NoiseModel>& models, const NoiseModel& model) {
    double values = 0;
    double degrees = 0;
    double lag = 0;
    double bias = 0;
    double kurtosis = 0;
    double relative = 0;  // variance
    for (const NoiseModel& other : models) {
        if (other.rows_estimated && other.observable == model.observable && other.conditions > 1) {
            const auto weight = static_cast<double>(other.values);
            values += weight;
            degrees += other.degrees;
            relative += other.degrees * other.relative.value * other.relative.value;
            lag += weight * other.autocorrelation;
            bias += other.sample_estimated ? weight / static_cast<double>(other.conditions) : 0.0;
            kurtosis += weight * other.excess_kurtosis;
        }
    }
    ErrorShape shape;
    shape.law.degrees = model.degrees;
    if (values == 0 || !model.rows_estimated) {
        return shape;
    }
    // Few replicates say little about their scatter: it is drawn towards that of the other tables (Smyth 2004).
    constexpr double prior_degrees = 20;
    const double borrowed = std::min(prior_degrees, degrees - model.degrees);
    const double own_relative = model.relative.value * model.relative.value;
    if (borrowed > 0 && model.floor.value == 0 && own_relative > 0) {
        shape.law.degrees += borrowed;
        shape.factor = std::sqrt((model.degrees * own_relative + borrowed * relative / degrees) / shape.law.degrees / own_relative);
    }
    constexpr double significant = 2;  // standard errors
    constexpr double strongest = 0.9;
    // Mean of the lag-one coefficient of n rows about their mean, a sample effect: rho - (1 + 3 rho) / n (Kendall 1954).
    const double own = bias / values;
    if (lag / values + own > significant / std::sqrt(degrees) && own < 0.25) {
        const double correlation = std::min(strongest, (lag / values + own) / (1 - 3 * own));
        shape.law.correlation = correlation;
        shape.law.correlation_error = std::sqrt((1 - correlation * correlation) / degrees) / (1 - 3 * own);
        shape.factor *= model.sample_estimated ? lost_to_effects(correlation, static_cast<double>(model.conditions)) : 1.0;
        // Variance of the variance of correlated numbers (Bayley and Hammersley 1946).
        shape.law.degrees *= (1 - correlation * correlation) / (1 + correlation * correlation);
    }
    // Kurtosis of Student's t: 6 / (nu - 4); residuals carry about `degrees` independent numbers.
    if (kurtosis / values > significant * std::sqrt(24 / degrees)) {
        shape.law.tail = 4 + 6 * values / kurtosis;
        shape.law.degrees /= 1 + 0.5 * kurtosis / values;  // variance of a variance
    }
    return shape;
}

}  // namespace coagula::diagnose
