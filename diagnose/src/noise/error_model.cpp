// SPDX-License-Identifier: GPL-3.0-or-later
#include "error_model.hpp"

#include <coagula/common/log_probability.hpp>

#include "low_rank.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr int most_rounds = 20;
constexpr double infinite = std::numeric_limits<double>::infinity();

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

/// The factors on the variances of rows, the first of those whose deviations are known: 1.
class ErrorModel::Scales {
public:
    explicit Scales(const ErrorModel& model)
        : degrees_(model.degrees_), variances_(model.degrees_.size() + 1, 1.0), counts_(variances_.size(), 0.0) {
        for (std::size_t scale = 0; scale < counts_.size(); ++scale) {
            counts_[scale] = static_cast<double>(model.belonging_->rows[scale].size());
        }
    }

    const std::vector<double>& variances() const { return variances_; }

    /// One step towards the most probable variances. @param squares expected sums of the residuals. Returns the largest change.
    double update(const std::vector<double>& squares) {
        double change = 0;
        for (std::size_t k = 1; k < variances_.size(); ++k) {
            const double degrees = degrees_[k - 1];
            const double next = (degrees + squares[k]) / (degrees + counts_[k]);
            change = std::max(change, std::abs(std::log(next / variances_[k])));
            variances_[k] = next;
        }
        return change;
    }

    /// What they add to the logarithm of the density: of the rows' errors, of their priors, and of their own uncertainty.
    double log_density() const {
        double sum = 0;
        for (std::size_t k = 1; k < variances_.size(); ++k) {
            const double degrees = degrees_[k - 1];
            sum += log_prior_of_scale(variances_[k], degrees) - 0.5 * counts_[k] * std::log(variances_[k]) +
                   0.5 * std::log(4 * std::numbers::pi / (degrees + counts_[k]));
        }
        return sum;
    }

private:
    const std::vector<double>& degrees_;
    std::vector<double> variances_;
    std::vector<double> counts_;
};

ErrorModel::ErrorModel(const DataSet& data)
    : data_(data),
      white_(data.noise.whiten(data.values)),
      log_determinant_(data.noise.log_determinant()),
      variances_(variances_about(data.effect * data.effect, data.effect_degrees)) {
    std::map<std::pair<double, bool>, std::size_t> numbers;
    std::vector<std::size_t> scaled;
    for (const Observation& one : data.observations) {
        const double degrees = one.errors.degrees;
        if (!std::isfinite(degrees)) {
            scaled.push_back(0);
            continue;
        }
        const auto [found, added] = numbers.try_emplace({degrees, has_error_of_phase(one)}, degrees_.size() + 1);
        if (added) {
            degrees_.push_back(degrees);
        }
        scaled.push_back(found->second);
    }
    scaled.resize(static_cast<std::size_t>(data.size()), 0);
    belonging_ = std::make_shared<Belonging>(data.sample, data.samples(), scaled, degrees_.size() + 1);
    Scales scales(*this);
    scales.update(std::vector<double>(degrees_.size() + 1, 0.0));
    saturated_ = scales.log_density() - 0.5 * log_determinant_;
}

std::vector<ScaledRows> ErrorModel::rows_of_scales() const {
    std::vector<ScaledRows> groups;
    for (std::size_t scale = 0; scale < degrees_.size(); ++scale) {
        groups.push_back({degrees_[scale], belonging_->rows[scale + 1]});
    }
    return groups;
}

/// Whitened slope by the level of the material. Rows of different samples have independent errors: whitening keeps the rows of
/// each together.
Eigen::VectorXd ErrorModel::whitened_level(const Prediction& prediction) const {
    Eigen::VectorXd level = whiten(prediction.level_slope);
    for (Index row = 0; row < size(); ++row) {
        level[row] = data_.sample[static_cast<std::size_t>(row)] >= 0 ? level[row] : 0.0;
    }
    return level;
}

/// Departures of the data from a prediction with what they share.
struct ErrorModel::Shared {
    Shared(const ErrorModel& model, const Prediction& prediction, const Eigen::MatrixXd& further)
        : plain(model.white_ - model.whiten(prediction.without_errors())) {
        level = model.whitened_level(prediction);
        errors = prediction.errors.changes.cols();
        others.resize(plain.size(), errors + further.cols());
        for (Index error = 0; error < errors; ++error) {
            others.col(error) = model.whiten(prediction.errors.changes.col(error));
        }
        if (further.cols() > 0) {
            others.rightCols(further.cols()) = further;
        }
        scales = Eigen::VectorXd::Ones(others.cols());
    }

    NormalEffects effects(const ErrorModel& model) const { return {model.belonging_, plain, level, others}; }

    /// Solves for the effects at the stated deviations.
    NormalEffects solved(const ErrorModel& model) const {
        NormalEffects all = effects(model);
        all.solve(model.data_.effect, scales, std::vector<double>(model.degrees_.size() + 1, 1.0));
        return all;
    }

    Eigen::VectorXd plain;
    Eigen::VectorXd level;
    Eigen::MatrixXd others;
    Eigen::VectorXd scales;  ///< deviations of the others
    Index errors = 0;        ///< of the prediction
};

Eigen::MatrixXd ErrorModel::directions(const Prediction& prediction) const {
    const Shared shared(*this, prediction, {});
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(size(), data_.samples() + shared.errors);
    for (Index row = 0; row < size(); ++row) {
        if (const Index sample = data_.sample[static_cast<std::size_t>(row)]; sample >= 0) {
            parts(row, sample) = shared.level[row];
        }
    }
    parts.rightCols(shared.errors) = shared.others;
    return parts;
}

Eigen::VectorXd ErrorModel::effects(const Prediction& prediction, const Eigen::MatrixXd& further) const {
    const Shared shared(*this, prediction, further);
    Eigen::VectorXd all = shared.solved(*this).most_probable();
    all.head(data_.samples()) *= data_.effect;
    all.conservativeResize(data_.samples() + shared.errors);
    return all;
}

Eigen::MatrixXd ErrorModel::effect_covariance(const Prediction& prediction) const {
    const Shared shared(*this, prediction, {});
    Eigen::MatrixXd all = shared.solved(*this).covariance();
    all.topRows(data_.samples()) *= data_.effect;
    all.leftCols(data_.samples()) *= data_.effect;
    return all;
}

Eigen::VectorXd ErrorModel::residual(const Prediction& prediction) const {
    return white_ - whiten(prediction.without_errors()) - directions(prediction) * effects(prediction);
}

/// Logarithm of the density at these deviations of effects and others, but for the rows' determinant. @param scales where to
/// start; holds the most probable ones then.
double ErrorModel::log_marginal(NormalEffects& effects, double effect, const Eigen::VectorXd& scales_of_others,
                                Scales& scales) const {
    constexpr double converged = 1e-2;  // at the most probable variances the density does not depend on them
    effects.solve(effect, scales_of_others, scales.variances());
    for (int round = 0; !degrees_.empty() && round < most_rounds; ++round) {
        const double change = scales.update(effects.expected_squares());
        effects.solve(effect, scales_of_others, scales.variances());
        if (change < converged) {
            break;
        }
    }
    return log_at(effects, scales);
}

double ErrorModel::log_at(const NormalEffects& effects, const Scales& scales) {
    return scales.log_density() - 0.5 * (effects.log_determinant() + effects.misfit());
}

double ErrorModel::log_density(const Prediction& prediction, const Eigen::MatrixXd& further, Accuracy accuracy) const {
    Shared shared(*this, prediction, further);
    NormalEffects effects = shared.effects(*this);
    return log_density(shared, effects, prediction.errors.degrees, accuracy);
}

/// The variances of rows are those that are most probable at the prediction: there the density does not depend on them.
std::array<double, 3> ErrorModel::log_densities(const Prediction& prediction, const Prediction& change, Accuracy accuracy) const {
    Shared shared(*this, prediction, {});
    NormalEffects here = shared.effects(*this);
    std::array<NormalEffects, 2> sides{here, here};
    const Eigen::VectorXd plain = whiten(change.values);
    const Eigen::VectorXd level = whitened_level(change);
    sides[0].replace(shared.plain + plain, shared.level - level);
    sides[1].replace(shared.plain - plain, shared.level + level);
    Scales scales(*this);
    std::array<std::vector<double>, 3> logarithms;
    for_deviations(shared, prediction.errors.degrees, accuracy, [&](double effect) {
        logarithms[1].push_back(log_marginal(here, effect, shared.scales, scales));
        for (std::size_t side = 0; side < sides.size(); ++side) {
            sides.at(side).solve(effect, shared.scales, scales.variances());
            logarithms.at(2 * side).push_back(log_at(sides.at(side), scales));
        }
    });
    std::array<double, 3> densities{};
    std::transform(logarithms.begin(), logarithms.end(), densities.begin(),
                   [&](const std::vector<double>& all) { return mean_density(all); });
    return densities;
}

std::vector<double> ErrorModel::log_densities(const Prediction& prediction, const Eigen::MatrixXd& further, Index last,
                                              std::span<const double> deviations) const {
    Shared shared(*this, prediction, further);
    NormalEffects effects = shared.effects(*this);
    std::vector<double> densities;
    for (const double deviation : deviations) {
        shared.scales.tail(last).setConstant(deviation);
        densities.push_back(log_density(shared, effects, prediction.errors.degrees, Accuracy::whole));
    }
    return densities;
}

/// Calls `at` with every deviation of the effects, those of the errors of the prediction being set beside it.
/// @param degrees of freedom of the variance of these.
template <class At>
void ErrorModel::for_deviations(Shared& shared, double degrees, Accuracy accuracy, const At& at) const {
    const std::vector<double> variances = variances_about(1, shared.errors > 0 ? degrees : infinite);
    const auto at_pair = [&](std::size_t of_effect, std::size_t of_error) {
        shared.scales.head(shared.errors).setConstant(std::sqrt(variances[variances.size() > 1 ? of_error : 0]));
        at(std::sqrt(variances_[variances_.size() > 1 ? of_effect : 0]));
    };
    if (accuracy == Accuracy::middle) {
        at_pair(beside.size() / 2, beside.size() / 2);
        return;
    }
    for (std::size_t k = 0; k < std::max(variances_.size(), variances.size()); ++k) {
        at_pair(k, beside.at(k));
    }
}

/// @param degrees as there.
double ErrorModel::log_density(Shared& shared, NormalEffects& effects, double degrees, Accuracy accuracy) const {
    Scales scales(*this);  // hardly others from one deviation of the effects to the next
    std::vector<double> logarithms;
    for_deviations(shared, degrees, accuracy,
                   [&](double effect) { logarithms.push_back(log_marginal(effects, effect, shared.scales, scales)); });
    return mean_density(logarithms);
}

/// Mean density over equally probable deviations, as a logarithm.
double ErrorModel::mean_density(const std::vector<double>& logarithms) const {
    const double density = log_mean(logarithms) - 0.5 * log_determinant_;
    if (density > saturated_ + 1e-6 * (1 + std::abs(saturated_))) {
        throw std::logic_error("the density of the data exceeds that of a prediction that meets every number");
    }
    return density;
}

}  // namespace coagula::diagnose
