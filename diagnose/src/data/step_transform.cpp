// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_transform.hpp"

#include "lagrange.hpp"
#include "step_ends.hpp"
#include "step_smoothing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr Index parts = 8;          ///< of the step from a row to the next
constexpr double of_halves = 0.25;  ///< of the difference from every other row, which is the error by interpolation
constexpr double known = 0.01;      ///< standard deviation of size and phase at best
constexpr double frequencies_per_decade = 5;

/// Points between some rows, each with the rows whose values give its own.
struct FinePoints {
    Eigen::ArrayXd times;
    std::vector<std::array<Index, 4>> rows;
    std::vector<std::array<double, 4>> weights;
};

FinePoints points_between(const Eigen::ArrayXd& times, const std::vector<Index>& rows) {
    const auto count = static_cast<Index>(rows.size());
    FinePoints points{Eigen::ArrayXd(parts * (count - 1) + 1), {}, {}};
    for (Index point = 0; point < points.times.size(); ++point) {
        const Index interval = std::min(point / parts, count - 2);
        const double way = static_cast<double>(point - parts * interval) / static_cast<double>(parts);
        const auto row = [&](Index place) { return rows[static_cast<std::size_t>(place)]; };
        const double time = times[row(interval)] + way * (times[row(interval + 1)] - times[row(interval)]);
        const Index first = std::clamp<Index>(interval - 1, 0, count - 4);
        const std::array<Index, 4> near{row(first), row(first + 1), row(first + 2), row(first + 3)};
        points.times[point] = time;
        points.rows.push_back(near);
        points.weights.push_back(lagrange_weights(times, near, time));
    }
    return points;
}

/// Weights of the two ends of a straight line in i w times its integral times exp(-i w (t - start)). @param x i w times its length.
std::pair<Complex, Complex> line_weights(Complex x) {
    constexpr double small = 1e-3;
    if (std::abs(x) < small) {
        return {x * (0.5 - x / 6.0 + x * x / 24.0), x * (0.5 - x / 3.0 + x * x / 8.0)};
    }
    const Complex end = std::exp(-x);
    const Complex mean = (1.0 - end) / x;
    return {1.0 - mean, mean - end};
}

/// Weights of all rows in i w times the integral from the first row to the last.
Eigen::VectorXcd weights_of(const FinePoints& points, double frequency, Index rows) {
    Eigen::VectorXcd fine = Eigen::VectorXcd::Zero(points.times.size());
    const Complex turn(0, frequency);
    for (Index k = 0; k + 1 < fine.size(); ++k) {
        const Complex begin = std::exp(-turn * points.times[k]);
        const auto [left, right] = line_weights(turn * (points.times[k + 1] - points.times[k]));
        fine[k] += begin * left;
        fine[k + 1] += begin * right;
    }
    Eigen::VectorXcd weights = Eigen::VectorXcd::Zero(rows);
    for (Index k = 0; k < fine.size(); ++k) {
        const auto place = static_cast<std::size_t>(k);
        for (std::size_t i = 0; i < 4; ++i) {
            weights[points.rows[place].at(i)] += points.weights[place].at(i) * fine[k];
        }
    }
    return weights;
}

/// All rows, and two choices of every other one with the first and the last.
std::array<FinePoints, 3> all_and_halves(const Eigen::ArrayXd& times) {
    std::array<std::vector<Index>, 3> rows;
    for (Index row = 0; row < times.size(); ++row) {
        const bool end = row == 0 || row + 1 == times.size();
        rows[0].push_back(row);
        for (Index half = 0; half < 2; ++half) {
            if (end || row % 2 == half) {
                rows.at(static_cast<std::size_t>(half) + 1).push_back(row);
            }
        }
    }
    return {points_between(times, rows[0]), points_between(times, rows[1]), points_between(times, rows[2])};
}

/// Errors of one row over its value.
struct RelativeErrors {
    Eigen::VectorXcd of_scatter;  ///< weights of the values times their deviations, over the value
    double of_conversion;         ///< size of what else may be wrong
};

/// Correlation of the errors of two rows: those of the conversion go together, what is not known of either row does not.
double correlation_of(const RelativeErrors& one, const RelativeErrors& other) {
    const auto size = [](const RelativeErrors& errors) {
        return std::hypot(errors.of_scatter.norm(), errors.of_conversion, std::sqrt(2.0) * known);
    };
    const double common = one.of_scatter.dot(other.of_scatter).real() + one.of_conversion * other.of_conversion;
    const double sizes = size(one) * size(other);
    return sizes > 0 ? common / sizes : 0;
}

}  // namespace

std::vector<double> frequencies_within(const Eigen::ArrayXd& times) {
    const double first = times[0] > 0 ? times[0] : times[1];
    const double last = times[times.size() - 1];
    std::vector<double> frequencies;
    const double above = std::floor(-frequencies_per_decade * std::log10(first) + 1e-9);
    for (double k = std::ceil(-frequencies_per_decade * std::log10(last) - 1e-9); k <= above; ++k) {
        frequencies.push_back(std::pow(10, k / frequencies_per_decade));
    }
    return frequencies;
}

std::vector<TransformedRow> transform(const StepResponse& response, const std::vector<double>& frequencies) {
    const Index rows = response.values.size();
    const Smoother smoother(response.values, response.deviations);
    const Eigen::VectorXd values = smoother.smoothed(response.values);
    const StepStart start(response.times, values, response.least_power, response.most_power);
    const StepEnd end(response.times, values, response.deviations);
    const std::array<FinePoints, 3> points = all_and_halves(response.times);
    std::vector<TransformedRow> transformed;
    std::vector<RelativeErrors> errors;
    for (const double frequency : frequencies) {
        const Eigen::VectorXcd between = weights_of(points[0], frequency, rows);
        double interpolation = 0;
        for (std::size_t half = 1; half < points.size(); ++half) {
            const Eigen::VectorXcd difference = weights_of(points.at(half), frequency, rows) - between;
            interpolation = std::max(interpolation, of_halves * std::abs(difference.cwiseProduct(values).sum()));
        }
        Eigen::VectorXcd weights = between + end.weights(frequency);
        weights[0] += start.weight(frequency);
        const Complex value = weights.cwiseProduct(values).sum();
        const double ends = std::hypot(start.error(frequency), end.error(frequency));
        errors.push_back({smoother.on_values(weights).cwiseProduct(response.deviations) / value,
                          std::hypot(interpolation, ends) / std::abs(value)});
        const RelativeErrors& here = errors.back();
        const double conversion = here.of_conversion / std::sqrt(2.0);  // in any direction
        transformed.push_back({frequency, value, std::hypot(here.of_scatter.real().norm(), conversion, known),
                               std::hypot(here.of_scatter.imag().norm(), conversion, known),
                               errors.size() > 1 ? correlation_of(here, errors[errors.size() - 2]) : 0.0});
    }
    return transformed;
}

}  // namespace coagula::diagnose
