// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_smoothing.hpp"

#include "lagrange.hpp"

#include <coagula/common/dense.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

using Eigen::Index;

constexpr Index stretch = 15;            ///< rows in which a curve must not miss the values
constexpr double tail = 6;               ///< degrees of freedom of Student's distribution, so that outliers count less
constexpr double of_normal = 1 / 0.875;  ///< standard deviation of normal numbers over the scale by that distribution
constexpr double reserve = 30;           ///< by which the smoothing stays below the strongest that the scatter allows
constexpr double least_scatter = 1e-12;  ///< over the largest value: what rounding leaves

/// Logarithm of Student's density of residuals whose scale has a floor and a part in proportion to the value, up to a constant.
double log_density(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& value_squares, double floor, double relative) {
    const Eigen::ArrayXd variances = floor * floor + relative * relative * value_squares;
    return (-0.5 * variances.log() - 0.5 * (tail + 1) * (1 + squares / (tail * variances)).log()).sum();
}

/// Mean sizes of seven values about each.
Eigen::ArrayXd levels_of(const Eigen::VectorXd& values) {
    constexpr Index beside = 3;
    Eigen::ArrayXd levels(values.size());
    for (Index row = 0; row < values.size(); ++row) {
        const Index reach = std::min({beside, row, values.size() - 1 - row});
        levels[row] = values.segment(row - reach, 2 * reach + 1).cwiseAbs().mean();
    }
    return levels;
}

/// Squares of the distances of values from the cubics through their four neighbours, over the variance that these add.
Eigen::ArrayXd residual_squares(const Eigen::ArrayXd& times, const Eigen::VectorXd& values) {
    const Index rows = values.size();
    Eigen::ArrayXd squares(rows);
    for (Index row = 0; row < rows; ++row) {
        const Index first = std::clamp<Index>(row - 2, 0, rows - 5);
        std::array<Index, 4> neighbours{};
        for (Index k = 0, place = first; k < 4; ++k, ++place) {
            place += place == row ? 1 : 0;
            neighbours.at(static_cast<std::size_t>(k)) = place;
        }
        const std::array<double, 4> weights = lagrange_weights(times, neighbours, times[row]);
        double residual = values[row];
        double sum = 1;
        for (std::size_t k = 0; k < 4; ++k) {
            residual -= weights.at(k) * values[neighbours.at(k)];
            sum += weights.at(k) * weights.at(k);
        }
        squares[row] = residual * residual / sum;
    }
    return squares;
}

/// Places near a floor and a relative part that a search tries.
std::array<std::pair<double, double>, 6> steps_from(double floor, double relative, double factor) {
    const double more = relative * factor;
    return {{{floor * factor, relative},
             {floor / factor, relative},
             {floor, more},
             {floor, relative / factor},
             {floor / factor, more},
             {floor * factor, relative / factor}}};
}

/// The logarithm of deviations as a polynomial of the fourth degree of the row: it does not scatter as they do.
Eigen::VectorXd even_course(const Eigen::VectorXd& deviations) {
    constexpr Index powers = 5;
    const Index rows = deviations.size();
    const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(rows, -1, 1);
    Eigen::MatrixXd functions(rows, powers);
    for (Index k = 0; k < powers; ++k) {
        functions.col(k) = place.pow(static_cast<double>(k));
    }
    const Eigen::VectorXd logarithms = deviations.array().log();
    const dense::LeastSquares fit(functions, logarithms);
    return (functions * fit.solution.col(0)).array().exp();
}

/// Mean square of a stretch of normal numbers, so many standard deviations above its mean (Wilson and Hilferty 1931).
double largest_mean_square(double deviations) {
    const double part = 2 / (9 * static_cast<double>(stretch));
    return std::pow(1 - part + deviations * std::sqrt(part), 3);
}

/// Whether the values scatter about the curve by no more than their deviations, as a whole and in every stretch.
bool is_scatter(const Eigen::ArrayXd& squares) {
    if (squares.mean() > 1) {
        return false;
    }
    const double stretches = static_cast<double>(squares.size()) / static_cast<double>(stretch);
    const double most_in_stretch = largest_mean_square(1 + std::sqrt(2 * std::log(stretches)));  // of so many, by chance
    for (Index first = 0; first + stretch <= squares.size(); ++first) {
        if (squares.segment(first, stretch).mean() > most_in_stretch) {
            return false;
        }
    }
    return true;
}

}  // namespace

Eigen::VectorXd scatter_of(const Eigen::ArrayXd& times, const Eigen::VectorXd& values) {
    const Eigen::ArrayXd squares = residual_squares(times, values);
    const Eigen::ArrayXd value_squares = levels_of(values).square();
    const double least_floor = least_scatter * std::sqrt(value_squares.maxCoeff());
    double floor = std::max(least_floor, std::sqrt(squares.mean()));
    double relative = std::max(least_scatter, floor / std::sqrt(value_squares.maxCoeff()));
    double best = log_density(squares, value_squares, floor, relative);
    for (double factor = 10; factor > 1.02; factor = std::sqrt(factor)) {
        for (bool moved = true; moved;) {
            moved = false;
            for (const auto& [some_floor, some_relative] : steps_from(floor, relative, factor)) {
                const double tried = std::max(some_floor, least_floor);
                if (const double density = log_density(squares, value_squares, tried, some_relative); density > best + 1e-9) {
                    best = density;
                    floor = tried;
                    relative = some_relative;
                    moved = true;
                }
            }
        }
    }
    return of_normal * (floor * floor + relative * relative * value_squares).sqrt();
}

BandedFactor::BandedFactor(Eigen::Matrix<double, 4, Eigen::Dynamic> bands) : bands_(std::move(bands)) {
    for (Index row = 0; row < bands_.cols(); ++row) {
        for (Index d = std::min<Index>(3, row); d >= 0; --d) {
            double rest = bands_(d, row);
            for (Index e = d + 1; e <= std::min<Index>(3, row); ++e) {
                rest -= bands_(e, row) * bands_(e - d, row - d);
            }
            bands_(d, row) = d == 0 ? std::sqrt(rest) : rest / bands_(0, row - d);
        }
    }
}

Eigen::VectorXd BandedFactor::solve(Eigen::VectorXd right) const {
    const Index rows = bands_.cols();
    for (Index row = 0; row < rows; ++row) {
        for (Index d = 1; d <= std::min<Index>(3, row); ++d) {
            right[row] -= bands_(d, row) * right[row - d];
        }
        right[row] /= bands_(0, row);
    }
    for (Index row = rows - 1; row >= 0; --row) {
        for (Index d = 1; d <= std::min<Index>(3, rows - 1 - row); ++d) {
            right[row] -= bands_(d, row + d) * right[row + d];
        }
        right[row] /= bands_(0, row);
    }
    return right;
}

Smoother::Smoother(const Eigen::VectorXd& values, const Eigen::VectorXd& deviations) {
    if (values.size() < stretch || !(deviations.array() > 0).all()) {
        return;
    }
    scales_ = even_course(deviations);
    precision_ = scales_.cwiseQuotient(deviations).cwiseAbs2();
    std::optional<double> strongest;
    for (double strength = 1e-2; strength < 1e9; strength *= std::sqrt(10.0)) {
        factor_ = factor(strength);
        if (!is_scatter((values - smoothed(values)).cwiseQuotient(deviations).array().square())) {
            break;
        }
        strongest = strength;
    }
    factor_ = strongest ? std::optional(factor(*strongest / reserve)) : std::nullopt;
}

BandedFactor Smoother::factor(double strength) const {
    constexpr std::array<double, 4> difference{-1, 3, -3, 1};
    Eigen::Matrix<double, 4, Eigen::Dynamic> bands = Eigen::Matrix<double, 4, Eigen::Dynamic>::Zero(4, precision_.size());
    bands.row(0) = precision_.transpose();
    for (Index first = 0; first + 4 <= precision_.size(); ++first) {
        for (Index i = 0; i < 4; ++i) {
            for (Index j = 0; j <= i; ++j) {
                bands(i - j, first + i) +=
                    strength * difference.at(static_cast<std::size_t>(i)) * difference.at(static_cast<std::size_t>(j));
            }
        }
    }
    return BandedFactor(std::move(bands));
}

Eigen::VectorXd Smoother::smoothed(const Eigen::VectorXd& values) const {
    return factor_ ? scales_.cwiseProduct(factor_->solve(precision_.cwiseProduct(values.cwiseQuotient(scales_)))) : values;
}

Eigen::VectorXcd Smoother::on_values(const Eigen::VectorXcd& weights) const {
    if (!factor_) {
        return weights;
    }
    const auto own = [this](const Eigen::VectorXd& some) -> Eigen::VectorXd {
        return precision_.cwiseProduct(factor_->solve(scales_.cwiseProduct(some))).cwiseQuotient(scales_);
    };
    Eigen::VectorXcd all(weights.size());
    all.real() = own(weights.real());
    all.imag() = own(weights.imag());
    return all;
}

}  // namespace coagula::diagnose
