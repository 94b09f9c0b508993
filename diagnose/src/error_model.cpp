#include "error_model.hpp"

#include "low_rank.hpp"
#include "weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr int most_rounds = 20;

/// Equally probable variances about an estimate from some degrees of freedom: scaled inverse chi-square.
std::vector<double> variances_about(double estimate, double degrees) {
    if (!std::isfinite(degrees) || estimate == 0) {
        return {estimate};
    }
    // Middles of seven equal parts of the normal distribution.
    std::vector<double> variances;
    for (const double normal : {-1.4652, -0.7916, -0.3661, 0.0, 0.3661, 0.7916, 1.4652}) {
        variances.push_back(estimate / scaled_chi_square(degrees, normal));
    }
    return variances;
}

/// Places of seven variances beside those of another quantity, so that both are spread evenly and independently.
constexpr std::array<std::size_t, 7> beside{3, 6, 1, 4, 0, 5, 2};

/// Logarithm of the density of the logarithm of a variance about 1 that is known from some degrees of freedom.
double log_prior_of_scale(double variance, double degrees) {
    const double half = 0.5 * degrees;
    return half * std::log(half) - std::lgamma(half) - half * (std::log(variance) + 1 / variance);
}

}  // namespace

ErrorModel::ErrorModel(const DataSet& data)
    : data_(data),
      white_(data.noise.whiten(data.values)),
      log_determinant_(data.noise.log_determinant()),
      variances_(variances_about(data.effect * data.effect, data.effect_degrees)) {
    std::map<std::pair<double, bool>, std::size_t> numbers;
    for (const Observation& one : data.observations) {
        const double degrees = one.errors.degrees;
        if (!std::isfinite(degrees)) {
            scaled_.push_back(0);
            continue;
        }
        const auto [found, added] = numbers.try_emplace({degrees, one.loss}, degrees_.size() + 1);
        if (added) {
            degrees_.push_back(degrees);
        }
        scaled_.push_back(found->second);
    }
    scaled_.resize(static_cast<std::size_t>(data.size()), 0);
}

Eigen::MatrixXd ErrorModel::directions(const Prediction& prediction) const {
    const Index errors = prediction.errors.changes.cols();
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(size(), data_.samples() + errors);
    // Rows of different samples have independent errors: whitening keeps each in its column.
    const Eigen::VectorXd level = whiten(prediction.level_slope);
    for (Index row = 0; row < size(); ++row) {
        if (const Index sample = data_.sample[static_cast<std::size_t>(row)]; sample >= 0) {
            parts(row, sample) = level[row];
        }
    }
    for (Index error = 0; error < errors; ++error) {
        parts.col(data_.samples() + error) = whiten(prediction.errors.changes.col(error));
    }
    return parts;
}

namespace {

/// Effects of the samples, of this deviation, and errors of the prediction about a whitened departure.
NormalEffects effects_about(const ErrorModel& model, const Prediction& prediction, double deviation) {
    Eigen::MatrixXd directions = model.directions(prediction);
    const Index samples = model.data().samples();
    const Eigen::VectorXd level = deviation * directions.leftCols(samples).rowwise().sum();
    return {level, model.data().sample, samples, directions.rightCols(directions.cols() - samples)};
}

}  // namespace

Eigen::VectorXd ErrorModel::effects(const Prediction& prediction) const {
    const double deviation = std::max(data_.effect, 0.0);
    NormalEffects effects = effects_about(*this, prediction, deviation);
    effects.solve(white_ - whiten(prediction.values), Eigen::VectorXd::Ones(size()));
    Eigen::VectorXd all = effects.most_probable();
    all.head(data_.samples()) *= deviation;
    return all;
}

Eigen::MatrixXd ErrorModel::effect_covariance(const Prediction& prediction) const {
    const double deviation = std::max(data_.effect, 0.0);
    NormalEffects effects = effects_about(*this, prediction, deviation);
    effects.solve(white_ - whiten(prediction.values), Eigen::VectorXd::Ones(size()));
    Eigen::MatrixXd all = effects.covariance();
    all.topRows(data_.samples()) *= deviation;
    all.leftCols(data_.samples()) *= deviation;
    return all;
}

Eigen::VectorXd ErrorModel::residual(const Prediction& prediction) const {
    return white_ - whiten(prediction.values) - directions(prediction) * effects(prediction);
}

/// The factors on the variances of rows whose deviations were estimated.
class ErrorModel::Scales {
public:
    explicit Scales(const ErrorModel& model)
        : model_(model), variances_(model.degrees_.size(), 1.0), counts_(model.degrees_.size(), 0.0) {
        for (const std::size_t scale : model.scaled_) {
            if (scale > 0) {
                counts_[scale - 1] += 1;
            }
        }
    }

    bool any() const { return !variances_.empty(); }

    /// Of each row, by which its squares count.
    Eigen::VectorXd weights() const {
        Eigen::VectorXd weights = Eigen::VectorXd::Ones(model_.size());
        for (Index row = 0; any() && row < weights.size(); ++row) {
            if (const std::size_t scale = model_.scaled_[static_cast<std::size_t>(row)]; scale > 0) {
                weights[row] /= variances_[scale - 1];
            }
        }
        return weights;
    }

    /// One step towards the most probable variances. @param squares expected ones of the residuals. Returns the largest change.
    double update(const Eigen::VectorXd& squares) {
        std::vector<double> sums = model_.degrees_;
        for (Index row = 0; row < squares.size(); ++row) {
            if (const std::size_t scale = model_.scaled_[static_cast<std::size_t>(row)]; scale > 0) {
                sums[scale - 1] += squares[row];
            }
        }
        double change = 0;
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const double next = sums[k] / (model_.degrees_[k] + counts_[k]);
            change = std::max(change, std::abs(std::log(next / variances_[k])));
            variances_[k] = next;
        }
        return change;
    }

    /// What they add to the logarithm of the density: of the rows' errors, of their priors, and of their own uncertainty.
    double log_density() const {
        double sum = 0;
        for (std::size_t k = 0; k < variances_.size(); ++k) {
            sum += log_prior_of_scale(variances_[k], model_.degrees_[k]) - 0.5 * counts_[k] * std::log(variances_[k]) +
                   0.5 * std::log(4 * std::numbers::pi / (model_.degrees_[k] + counts_[k]));
        }
        return sum;
    }

private:
    const ErrorModel& model_;
    std::vector<double> variances_;
    std::vector<double> counts_;
};

/// With effects of the samples along `level` and unit normal errors along `others`, but for the rows' determinant.
double ErrorModel::log_marginal(const Eigen::VectorXd& plain, const Eigen::VectorXd& level, const Eigen::MatrixXd& others) const {
    constexpr double converged = 1e-6;
    NormalEffects effects(level, data_.sample, data_.samples(), others);
    Scales scales(*this);
    effects.solve(plain, scales.weights());
    for (int round = 0; scales.any() && round < most_rounds; ++round) {
        const double change = scales.update(effects.expected_squares());
        effects.solve(plain, scales.weights());
        if (change < converged) {
            break;
        }
    }
    return scales.log_density() - 0.5 * (effects.log_determinant() + effects.misfit());
}

double ErrorModel::log_density(const Prediction& prediction, const Eigen::MatrixXd& further) const {
    const Eigen::MatrixXd all = directions(prediction);
    const Eigen::VectorXd level = all.leftCols(data_.samples()).rowwise().sum();
    const Index errors = prediction.errors.changes.cols();
    Eigen::MatrixXd others(size(), errors + further.cols());
    const std::vector<double> scales = variances_about(1, errors > 0 ? prediction.errors.degrees : INFINITY);
    const Eigen::VectorXd plain = white_ - whiten(prediction.values);
    std::vector<double> logarithms;
    for (std::size_t k = 0; k < std::max(variances_.size(), scales.size()); ++k) {
        const double effect = std::sqrt(variances_[variances_.size() > 1 ? k : 0]);
        const double error = std::sqrt(scales[scales.size() > 1 ? beside.at(k) : 0]);
        others.leftCols(errors) = error * all.rightCols(errors);
        if (further.cols() > 0) {
            others.rightCols(further.cols()) = further;
        }
        logarithms.push_back(log_marginal(plain, effect * level, others));
    }
    const double density = log_sum(logarithms) - std::log(static_cast<double>(logarithms.size())) - 0.5 * log_determinant_;
    if (density > saturated() + 1e-6 * (1 + std::abs(saturated()))) {
        throw std::logic_error("the density of the data exceeds that of a prediction that meets every number");
    }
    return density;
}

double ErrorModel::saturated() const {
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(size());
    return log_marginal(none, none, Eigen::MatrixXd(size(), 0)) - 0.5 * log_determinant_;
}

}  // namespace coagula::diagnose
