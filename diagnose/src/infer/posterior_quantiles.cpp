// SPDX-License-Identifier: GPL-3.0-or-later
// What a grid of nodes says between them: quantiles and the place of the maximum.
#include "posterior_grid.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/common/special_functions.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace coagula::diagnose {

namespace {

using Eigen::Index;

/// Where a growing function passes a value.
double halved(const std::function<double(double)>& function, double value, double low, double high) {
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (function(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Logarithms of the density along an axis, at the nodes of a grid along the axes.
std::vector<double> log_marginal(const PosteriorGrid& grid, Index axis) {
    const auto number = static_cast<std::size_t>(axis);
    std::size_t stride = 1;
    for (std::size_t before = 0; before < number; ++before) {
        stride *= static_cast<std::size_t>(grid.along[before]);
    }
    const auto count = static_cast<std::size_t>(grid.along[number]);
    std::vector<std::vector<double>> slices(count);
    for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
        slices[k / stride % count].push_back(grid.nodes[k].log_weight);
    }
    std::vector<double> marginal;
    for (const std::vector<double>& slice : slices) {
        marginal.push_back(log_sum(slice));
    }
    return marginal;
}

/// A density at many places of equal distance, whose logarithm is a parabola through the nearest three of some nodes.
class DensityAlongAxis {
public:
    /// @param low end of the first cell. @param width of a cell. @param heights logarithms at the middles of the cells.
    DensityAlongAxis(double low, double width, const std::vector<double>& heights) : low_(low), step_(width / parts) {
        const double largest = *std::max_element(heights.begin(), heights.end());
        double sum = 0;
        for (std::size_t cell = 0; cell < heights.size(); ++cell) {
            for (int part = 0; part < parts; ++part) {
                const double offset = (part + 0.5) / parts - 0.5;  // cells from the middle
                sum += std::exp(height_at(heights, cell, offset) - largest);
                below_.push_back(sum);
            }
        }
    }

    double quantile(double part) const {
        const double wanted = part * below_.back();
        const auto found = std::lower_bound(below_.begin(), below_.end(), wanted);
        const auto number = std::min(static_cast<std::size_t>(found - below_.begin()), below_.size() - 1);
        const double before = number == 0 ? 0.0 : below_[number - 1];
        const double within = (wanted - before) / std::max(below_[number] - before, std::numeric_limits<double>::min());
        return low_ + step_ * (static_cast<double>(number) + std::clamp(within, 0.0, 1.0));
    }

private:
    static constexpr int parts = 64;       ///< of a cell
    static constexpr double deepest = 60;  ///< logarithms from node to node

    static double height_at(const std::vector<double>& heights, std::size_t cell, double offset) {
        if (heights.size() < 3) {
            return heights[cell];
        }
        const std::size_t middle = std::clamp<std::size_t>(cell, 1, heights.size() - 2);
        const double here = heights[middle];
        const double before = std::clamp(heights[middle - 1] - here, -deepest, deepest);
        const double after = std::clamp(heights[middle + 1] - here, -deepest, deepest);
        const double place = offset + static_cast<double>(cell) - static_cast<double>(middle);
        return here + 0.5 * place * ((after - before) + place * (after + before));
    }

    double low_;
    double step_;
    std::vector<double> below_;  ///< sums of the density
};

/// Places and heights of nodes about the best one, in cells along the edges of its cell.
struct NodesAround {
    Eigen::MatrixXd places;   ///< nodes x axes
    Eigen::VectorXd heights;  ///< log weights less that of the best node
};

/// Nodes within a cell to either side of the best one; within two where there are none on the other side.
NodesAround neighbours_of_best(const PosteriorGrid& grid) {
    constexpr double near = 1.01;
    constexpr double least = 0.4;
    const std::size_t best = grid.best();
    Eigen::MatrixXd away(static_cast<Index>(grid.nodes.size()), grid.cell.cols());
    for (Index k = 0; k < away.rows(); ++k) {
        away.row(k) = grid.cell.triangularView<Eigen::Lower>().solve(grid.places[static_cast<std::size_t>(k)] - grid.places[best]);
    }
    const auto bounds = [&](const Eigen::RowVectorXd& farthest_on_other_side) -> Eigen::RowVectorXd {
        return near * (1 + (farthest_on_other_side.array() < least).cast<double>());
    };
    const Eigen::RowVectorXd above = bounds(-away.colwise().minCoeff());
    const Eigen::RowVectorXd below = bounds(away.colwise().maxCoeff());
    std::vector<Index> kept;
    for (Index k = 0; k < away.rows(); ++k) {
        if ((away.row(k).array() < above.array()).all() && (away.row(k).array() > -below.array()).all()) {
            kept.push_back(k);
        }
    }
    NodesAround neighbours{away(kept, Eigen::all), Eigen::VectorXd(static_cast<Index>(kept.size()))};
    for (std::size_t k = 0; k < kept.size(); ++k) {
        neighbours.heights[static_cast<Index>(k)] =
            grid.nodes[static_cast<std::size_t>(kept[k])].log_weight - grid.nodes[best].log_weight;
    }
    return neighbours;
}

/// A paraboloid: slope and second derivatives where the best node is.
struct Paraboloid {
    Eigen::VectorXd slope;
    Eigen::MatrixXd bend;

    /// Step to the maximum, at most one cell; where there is none, along each axis by itself.
    Eigen::VectorXd step() const {
        const Eigen::LLT<Eigen::MatrixXd> down(-bend);
        Eigen::VectorXd whole = Eigen::VectorXd::Zero(slope.size());
        if (down.info() == Eigen::Success) {
            whole = down.solve(slope);
        } else {
            whole = (bend.diagonal().array() < 0).select(-slope.array() / bend.diagonal().array(), 0.0).matrix();
        }
        return whole.cwiseMax(-1).cwiseMin(1);
    }
    double gain(const Eigen::VectorXd& step) const { return slope.dot(step) + 0.5 * step.dot(bend * step); }
};

/// Fits a paraboloid by least squares, high nodes above all; returns none where there are too few nodes.
std::optional<Paraboloid> paraboloid_through(const NodesAround& neighbours) {
    constexpr double lightness = 0.1;  // of low nodes
    const Index axes = neighbours.places.cols();
    const Index terms = 1 + axes + axes * (axes + 1) / 2;
    if (neighbours.places.rows() < terms) {
        return std::nullopt;
    }
    Eigen::MatrixXd columns(neighbours.places.rows(), terms);
    columns.col(0).setOnes();
    columns.middleCols(1, axes) = neighbours.places;
    for (Index one = 0, column = 1 + axes; one < axes; ++one) {
        for (Index other = one; other < axes; ++other, ++column) {
            columns.col(column) =
                neighbours.places.col(one).cwiseProduct(neighbours.places.col(other)) * (one == other ? 0.5 : 1.0);
        }
    }
    const Eigen::VectorXd weights = (lightness * neighbours.heights.cwiseMax(-60)).array().exp();
    const Eigen::VectorXd coefficients =
        (weights.asDiagonal() * columns).colPivHouseholderQr().solve(weights.cwiseProduct(neighbours.heights));
    Paraboloid found{coefficients.segment(1, axes), Eigen::MatrixXd(axes, axes)};
    for (Index one = 0, column = 1 + axes; one < axes; ++one) {
        for (Index other = one; other < axes; ++other, ++column) {
            found.bend(one, other) = coefficients[column];
            found.bend(other, one) = coefficients[column];
        }
    }
    return found;
}

/// Probability below a place where every node about a mode stands for a normal distribution as wide as half a cell, and the nodes
/// are drawn together so that all of it is as wide as they are by themselves.
std::function<double(double)> below_by_normals(const PosteriorGrid& grid, const std::vector<double>& probability, Index axis) {
    const double half = grid.half_widths[axis];
    const auto [mean, covariance] = grid.moments();
    const double together = std::sqrt(std::max(0.0, 1 - half * half / covariance(axis, axis)));
    return [&grid, &probability, axis, half, together, middle = mean[axis]](double place) {
        double sum = 0;
        for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
            const double departure = (place - middle - together * (grid.places[k][axis] - middle)) / half;
            sum += probability[k] * 0.5 * std::erfc(-departure / std::numbers::sqrt2);
        }
        return sum;
    };
}

/// The same where the prior cuts off a part: every node stands for its cell.
std::function<double(double)> below_by_cells(const PosteriorGrid& grid, const std::vector<double>& probability, Index axis) {
    const double half = grid.half_widths[axis];
    return [&grid, &probability, axis, half](double place) {
        double sum = 0;
        for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
            sum += probability[k] * std::clamp((place - grid.places[k][axis] + half) / (2 * half), 0.0, 1.0);
        }
        return sum;
    };
}

/// Quantile of a normal distribution about 0 of which only what lies between two ends above or about 0 is left.
double quantile_between(double low, double high, double part) {
    const auto above = [](double place) { return 0.5 * std::erfc(place / std::numbers::sqrt2); };
    return upper_normal_quantile(std::lerp(above(low), above(high), part));
}

}  // namespace

std::pair<double, double> middle_within_prior(double mean, double deviation, double part) {
    constexpr double farthest = 30;  // standard deviations from the ends
    const double outside = 0.5 * (1 - part);
    const double limited = std::clamp(mean, -farthest * deviation, 1 + farthest * deviation);
    const bool turned = limited > 0.5;  // the distribution is symmetric: its mean is made to lie towards 0
    const double about = turned ? 1 - limited : limited;
    const auto at = [&](double share) {
        return std::clamp(about + deviation * quantile_between(-about / deviation, (1 - about) / deviation, share), 0.0, 1.0);
    };
    return turned ? std::pair{1 - at(1 - outside), 1 - at(outside)} : std::pair{at(outside), at(1 - outside)};
}

double PosteriorGrid::quantile(Index axis, double part) const {
    const double half = half_widths[axis];
    if (!along.empty()) {
        double low = std::numeric_limits<double>::infinity();
        for (const Eigen::VectorXd& place : places) {
            low = std::min(low, place[axis]);
        }
        return DensityAlongAxis(low - half, 2 * half, log_marginal(*this, axis)).quantile(part);
    }
    const std::vector<double> probability = probabilities_of(log_weights());
    return halved(clipped ? below_by_cells(*this, probability, axis) : below_by_normals(*this, probability, axis), part, 0, 1);
}

std::optional<Eigen::VectorXd> PosteriorGrid::peak() const {
    constexpr double least_gain = 1e-3;  // logarithms
    const auto paraboloid = paraboloid_through(neighbours_of_best(*this));
    if (!paraboloid) {
        return std::nullopt;
    }
    const Eigen::VectorXd step = paraboloid->step();
    if (!(paraboloid->gain(step) > least_gain)) {
        return std::nullopt;
    }
    const Eigen::ArrayXd node = places[best()].array();
    const Eigen::ArrayXd place = node + (cell * step).array();
    return place.max(node.min(prior_edge)).min(node.max(1 - prior_edge)).matrix();
}

double PosteriorGrid::log_stiffness_quantile(double part, double further) const {
    constexpr double farthest = 10;  // standard deviations
    const std::vector<double> probability = probabilities_of(log_weights());
    const auto deviation = [&](const Node& node) { return std::hypot(node.deviation, further); };
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Node& node : nodes) {
        low = std::min(low, node.log_stiffness - farthest * deviation(node));
        high = std::max(high, node.log_stiffness + farthest * deviation(node));
    }
    const auto below = [&](double log_stiffness) {
        double sum = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            const double departure = (log_stiffness - nodes[k].log_stiffness) / deviation(nodes[k]);
            sum += probability[k] * 0.5 * std::erfc(-departure / std::numbers::sqrt2);
        }
        return sum;
    };
    return halved(below, part, low, high);
}

}  // namespace coagula::diagnose
