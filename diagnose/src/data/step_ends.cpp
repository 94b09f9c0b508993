// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_ends.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double power_known = 0.03;    ///< standard deviation at best
constexpr double lowest_power = -0.95;  ///< of a response whose integral is finite
constexpr double most_fall = 3;         ///< power with which a slope falls; beyond it nothing is left of it
constexpr double fall_known = 0.05;
constexpr double most_fall_error = 1.5;

std::vector<Index> rows_between(const Eigen::ArrayXd& times, double from, double to) {
    std::vector<Index> rows;
    for (Index row = 0; row < times.size(); ++row) {
        if (times[row] >= from && times[row] <= to) {
            rows.push_back(row);
        }
    }
    return rows;
}

/// Weights of values in the slope of the straight line through some of them.
Eigen::VectorXd weights_of_slope(const Eigen::ArrayXd& places, const std::vector<Index>& rows) {
    const Eigen::ArrayXd some = places(rows);
    const Eigen::ArrayXd from_middle = some - some.mean();
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(places.size());
    weights(rows) = from_middle / from_middle.square().sum();
    return weights;
}

/// The power of time that positive values follow between two times.
std::optional<double> power_between(const Eigen::ArrayXd& times, const Eigen::VectorXd& values, double from, double to) {
    const std::vector<Index> rows = rows_between(times, from, to);
    if (rows.size() < 2 || !(values(rows).array() > 0).all() || !(times[rows.front()] > 0)) {
        return std::nullopt;
    }
    const Eigen::VectorXd logarithms = values.array().max(std::numeric_limits<double>::min()).log();
    return weights_of_slope(times.max(times[rows.front()]).log(), rows).dot(logarithms);
}

/// The curve that is 0 at the time 1, where its slope is 1, and whose slope is a power of one over the time.
Eigen::ArrayXd curve_of_slope(const Eigen::ArrayXd& times, double power) {
    const Eigen::ArrayXd logarithms = times.max(std::numeric_limits<double>::min()).log();
    return power == 1 ? logarithms : Eigen::ArrayXd((((1 - power) * logarithms).exp() - 1) / (1 - power));
}

/// The power with which slopes fall between two times.
double fall_between(double late, double early, double factor) {
    const double ratio = late / early;
    return early == 0 ? 1 : ratio <= 0 ? most_fall : std::clamp(-std::log(ratio) / std::log(factor), 0.0, most_fall);
}

}  // namespace

StepStart::StepStart(const Eigen::ArrayXd& times, const Eigen::VectorXd& values, double least_power, double most_power)
    : time_(times[0]), value_(values[0]) {
    const auto power = power_between(times, values, time_, std::max(2 * time_, times[2]));
    if (time_ == 0 || !power) {
        return;
    }
    power_ = std::clamp(*power, least_power, most_power);
    const auto next = power_between(times, values, 2 * time_, std::max(4 * time_, times[4]));
    power_error_ = power_known + 0.5 * std::abs(next.value_or(*power + 1) - *power);
}

/// The series of the integral of (t / t1)^power exp(-i w t).
Complex StepStart::weight(double frequency, double power) const {
    const Complex x(0, frequency * time_);
    if (time_ == 0) {
        return 0;  // there is nothing before the first row
    }
    constexpr int terms = 30;
    Complex sum = 0;
    Complex term = 1;
    for (int m = 0; m < terms; ++m) {
        sum += term / (power + 1 + m);
        term *= -x / static_cast<double>(m + 1);
    }
    return x * sum;
}

double StepStart::error(double frequency) const {
    const Complex here = weight(frequency, power_);
    const double lower = std::abs(weight(frequency, std::max(power_ - power_error_, lowest_power)) - here);
    return std::abs(value_) * std::max(lower, std::abs(weight(frequency, power_ + power_error_) - here));
}

StepEnd::StepEnd(const Eigen::ArrayXd& times, const Eigen::VectorXd& values, const Eigen::VectorXd& deviations)
    : time_(times[times.size() - 1]) {
    const Index rows = times.size();
    std::vector<Index> late = rows_between(times, 0.5 * time_, time_);
    if (late.size() < 3) {
        late = {rows - 3, rows - 2, rows - 1};
    }
    std::vector<std::pair<double, double>> slopes{{times(late).mean(), weights_of_slope(times, late).dot(values)}};
    for (const double from : {0.25, 0.125}) {
        const std::vector<Index> some = rows_between(times, from * time_, 2 * from * time_);
        if (some.size() >= 2) {
            slopes.emplace_back(times(some).mean(), weights_of_slope(times, some).dot(values));
        }
    }
    std::vector<double> falls{1, 1};
    for (std::size_t k = 0; k + 1 < slopes.size(); ++k) {
        falls[k] = fall_between(slopes[k].second, slopes[k + 1].second, slopes[k].first / slopes[k + 1].first);
    }
    power_ = falls[0];

    const Eigen::ArrayXd curve = curve_of_slope(times / time_, power_) * time_;
    slope_weights_ = weights_of_slope(curve, late);
    level_weights_ = -curve(late).mean() * slope_weights_;
    level_weights_(late).array() += 1 / static_cast<double>(late.size());
    slope_ = slope_weights_.dot(values);
    const Eigen::VectorXd fitted = (level_weights_.dot(values) + slope_ * curve).matrix();
    ringing_ = std::sqrt((values - fitted)(late).squaredNorm() / static_cast<double>(late.size()));
    const double scatter = slope_weights_.cwiseProduct(deviations).norm();
    power_error_ = std::min(most_fall_error,
                            fall_known + 0.5 * std::abs(falls[0] - falls[1]) + (slope_ == 0 ? 0.0 : scatter / std::abs(slope_)));
}

/// The integral of (t / t_last)^-power exp(-i w t) from the last time on, along a line of complex times on which it does not
/// oscillate; by Simpson's rule.
Complex StepEnd::slope_weight(double frequency, double power) const {
    constexpr int steps = 600;
    constexpr double step = 0.05;
    Complex sum = 0;
    for (int k = 0; k <= steps; ++k) {
        const double x = step * k;
        const double weight = k == 0 || k == steps ? 1 : (k % 2 == 1 ? 4 : 2);
        sum += weight * std::exp(-x) * std::pow(Complex(1, -x / (frequency * time_)), -power);
    }
    return std::exp(Complex(0, -frequency * time_)) * Complex(0, -1 / frequency) * (sum * step / 3.0);
}

Eigen::VectorXcd StepEnd::weights(double frequency) const {
    return std::exp(Complex(0, -frequency * time_)) * level_weights_ + slope_weight(frequency, power_) * slope_weights_;
}

double StepEnd::error(double frequency) const {
    const Complex here = slope_weight(frequency, power_);
    const Complex exponential = std::exp(Complex(0, -frequency * time_)) / Complex(power_ / time_, frequency);
    double largest = std::abs(exponential - here);
    for (const double power : {std::max(0.0, power_ - power_error_), power_ + power_error_}) {
        largest = std::max(largest, std::abs(slope_weight(frequency, power) - here));
    }
    return std::hypot(slope_ * largest, ringing_);
}

}  // namespace coagula::diagnose
