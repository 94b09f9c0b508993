// SPDX-License-Identifier: GPL-3.0-or-later
// Errors as the noise model draws them.
#include "error_model.hpp"

#include "data/normal_number.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

/// One draw of everything that is uncertain about the errors, and of the errors.
class ErrorDraw {
public:
    ErrorDraw(std::uint64_t seed, std::uint64_t number) : seed_(seed), number_(number) {}

    double normal() { return normal_number(seed_, number_, next_++); }

    double unit_deviation(double degrees) {
        return std::isfinite(degrees) ? 1 / std::sqrt(scaled_chi_square(degrees, normal())) : 1.0;
    }

    /// What the true deviation is over the stated one; one draw per estimated noise model.
    double scale(const Observation& one) {
        const auto [scale, added] = scales_.try_emplace({one.errors.degrees, has_error_of_phase(one)}, 1.0);
        return scale->second = added ? unit_deviation(one.errors.degrees) : scale->second;
    }

    /// Draws an error of unit variance, with its tail.
    double error(const Observation& one) {
        const double tail = one.errors.tail;
        const double drawn = normal();
        return std::isfinite(tail) ? drawn * std::sqrt((tail - 2) / tail) * unit_deviation(tail) : drawn;
    }

    /// What the true correlation is where this one is stated; one draw of that of neighbouring rows for torque and phase each.
    double correlation(const Observation& one, double stated) {
        const auto [drawn, added] = correlations_.try_emplace(has_error_of_phase(one), 0.0);
        if (added) {
            drawn->second = std::clamp(one.errors.correlation + normal() * one.errors.correlation_error, 0.01, 0.95);
        }
        return std::pow(stated, std::log(drawn->second) / std::log(one.errors.correlation));
    }

private:
    std::uint64_t seed_;
    std::uint64_t number_;
    std::uint64_t next_ = 0;
    std::map<std::pair<double, bool>, double> scales_;
    std::map<bool, double> correlations_;
};

/// Each number after those of the rows before it.
std::vector<Index> by_rows(const std::vector<Observation>& observations) {
    std::vector<Index> order(observations.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
        return observations[static_cast<std::size_t>(a)].row < observations[static_cast<std::size_t>(b)].row;
    });
    return order;
}

}  // namespace

Eigen::VectorXd ErrorModel::draw(std::uint64_t seed, std::uint64_t number) const {
    const DataSet& data = data_;
    ErrorDraw draw(seed, number);
    Eigen::VectorXd errors(data.size() + (data.effect > 0 ? data.samples() : 0));
    Eigen::VectorXd coloured(data.size());  // of unit variance, as correlated as was drawn
    for (const Index k : by_rows(data.observations)) {
        const Observation& one = data.observations[static_cast<std::size_t>(k)];
        const double stated = data.noise.correlation[k];
        const double scale = draw.scale(one);
        double error = draw.error(one);
        coloured[k] = error;
        if (stated != 0 && one.errors.correlation_error > 0) {
            const double drawn = std::copysign(draw.correlation(one, std::abs(stated)), stated);
            const double before = coloured[data.noise.previous[static_cast<std::size_t>(k)]];
            coloured[k] = drawn * before + std::sqrt(1 - drawn * drawn) * error;
            error = (coloured[k] - stated * before) / std::sqrt(1 - stated * stated);
        }
        errors[k] = scale * error;
    }
    const double scale = draw.unit_deviation(data.effect_degrees);
    for (Index k = data.size(); k < errors.size(); ++k) {
        errors[k] = scale * draw.normal();
    }
    return errors;
}

Eigen::MatrixXd ErrorModel::covariance(const Prediction& prediction) const {
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(size(), size() + data_.samples());
    for (Index k = 0; k < size(); ++k) {
        parts.col(k) = data_.noise.coloured(Eigen::VectorXd::Unit(size(), k));
    }
    for (Index k = 0; k < size(); ++k) {
        if (const Index sample = data_.sample[static_cast<std::size_t>(k)]; sample >= 0) {
            parts(k, size() + sample) = data_.effect * prediction.level_slope[k];
        }
    }
    return parts * parts.transpose();
}

Eigen::VectorXd ErrorModel::drawn_about(const Prediction& prediction, std::uint64_t seed, std::uint64_t number) const {
    const Eigen::VectorXd drawn = draw(seed, number);
    Eigen::VectorXd values = prediction.without_errors() + data_.noise.coloured(drawn.head(size()));
    for (Index k = 0; k < size() && drawn.size() > size(); ++k) {
        if (const Index sample = data_.sample[static_cast<std::size_t>(k)]; sample >= 0) {
            values[k] += data_.effect * drawn[size() + sample] * prediction.level_slope[k];
        }
    }
    return values;
}

}  // namespace coagula::diagnose
