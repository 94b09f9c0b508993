#include "posterior_grid.hpp"

#include "noise/weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

/// Where a growing function passes a value.
double halved(const std::function<double(double)>& function, double value, double low, double high) {
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (function(middle) < value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

using Eigen::Index;

constexpr double relevant = 14;  // logarithms below the best node that count
constexpr double heavy = 6;      // logarithms below the best node that are not to lie at the edge of the grid
constexpr int most_rounds = 8;
constexpr double reach = 5;  // standard deviations

/// Nodes along an axis for so many axes.
int nodes_for(Index axes) {
    constexpr std::array<int, 5> nodes{1, 41, 15, 9, 7};
    const auto place = static_cast<std::size_t>(axes);
    return place < nodes.size() ? nodes.at(place) : 5;
}

/// Every node of a grid, as middles of cells 0 .. 1 along each axis.
std::vector<Eigen::VectorXd> middles(Index axes, int nodes) {
    std::size_t count = 1;
    for (Index axis = 0; axis < axes; ++axis) {
        count *= static_cast<std::size_t>(nodes);
    }
    std::vector<Eigen::VectorXd> all;
    for (std::size_t number = 0; number < count; ++number) {
        Eigen::VectorXd place(axes);
        std::size_t rest = number;
        for (Index axis = 0; axis < axes; ++axis) {
            place[axis] = (static_cast<double>(rest % static_cast<std::size_t>(nodes)) + 0.5) / nodes;
            rest /= static_cast<std::size_t>(nodes);
        }
        all.push_back(std::move(place));
    }
    return all;
}

std::vector<double> log_weights(const PosteriorGrid& grid) {
    std::vector<double> weights;
    for (const Node& node : grid.nodes) {
        weights.push_back(node.log_weight);
    }
    return weights;
}

}  // namespace

std::size_t PosteriorGrid::best() const {
    const auto found =
        std::max_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.log_weight < b.log_weight; });
    return static_cast<std::size_t>(found - nodes.begin());
}

double PosteriorGrid::log_evidence() const {
    return log_sum(log_weights(*this)) + log_cell;
}

double PosteriorGrid::effective_nodes() const {
    double squares = 0;
    for (const double probability : probabilities_of(log_weights(*this))) {
        squares += probability * probability;
    }
    return 1 / squares;
}

double PosteriorGrid::quantile(Index axis, double part) const {
    const std::vector<double> probability = probabilities_of(log_weights(*this));
    const double half = half_widths[axis];
    // A node stands for its cell.
    const auto below = [&](double place) {
        double sum = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            sum += probability[k] * std::clamp((place - places[k][axis] + half) / (2 * half), 0.0, 1.0);
        }
        return sum;
    };
    return halved(below, part, 0, 1);
}

double PosteriorGrid::log_stiffness_quantile(double part, double further) const {
    constexpr double farthest = 10;  // standard deviations
    const std::vector<double> probability = probabilities_of(log_weights(*this));
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

PosteriorGrid grid_along_axes(Index axes, const EvaluateNode& evaluate) {
    const int nodes = nodes_for(axes);
    const std::vector<Eigen::VectorXd> cells = middles(axes, nodes);
    Eigen::ArrayXd low = Eigen::ArrayXd::Zero(axes);
    Eigen::ArrayXd high = Eigen::ArrayXd::Ones(axes);
    PosteriorGrid grid;
    for (int round = 0; round < most_rounds; ++round) {
        grid = {};
        for (const Eigen::VectorXd& cell : cells) {
            grid.places.emplace_back((low + (high - low) * cell.array()).matrix());
            grid.nodes.push_back(evaluate(grid.places.back()));
        }
        const Eigen::ArrayXd width = (high - low) / nodes;
        grid.log_cell = width.log().sum();
        grid.half_widths = (0.5 * width).matrix();
        Eigen::ArrayXd next_low = Eigen::ArrayXd::Constant(axes, 1.0);
        Eigen::ArrayXd next_high = Eigen::ArrayXd::Zero(axes);
        // A ridge between the nodes of a coarse grid may lead out of the box: where it cuts the posterior, go beyond.
        Eigen::ArrayXd lowest = low;
        Eigen::ArrayXd highest = high;
        const double largest = grid.nodes[grid.best()].log_weight;
        for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
            const Eigen::ArrayXd place = grid.places[k].array();
            if (grid.nodes[k].log_weight > largest - relevant) {
                next_low = next_low.min(place - 1.5 * width);
                next_high = next_high.max(place + 1.5 * width);
            }
            if (grid.nodes[k].log_weight > largest - heavy) {
                lowest = (place < low + width).select(0.0, lowest);
                highest = (place > high - width).select(1.0, highest);
            }
        }
        next_low = next_low.max(lowest);
        next_high = next_high.min(highest);
        const bool inside = (next_low >= low).all() && (next_high <= high).all();
        if (axes == 0 || (inside && ((next_high - next_low) > 0.6 * (high - low)).all())) {
            break;
        }
        low = next_low;
        high = next_high;
    }
    return grid;
}

PosteriorGrid grid_about(const Eigen::VectorXd& mode, const Eigen::MatrixXd& factor, const EvaluateNode& evaluate) {
    const int nodes = std::min(15, nodes_for(mode.size()));
    PosteriorGrid grid;
    grid.log_cell = static_cast<double>(mode.size()) * std::log(2 * reach / nodes) + factor.diagonal().array().abs().log().sum();
    grid.half_widths = reach / nodes * factor.rowwise().norm();
    for (const Eigen::VectorXd& cell : middles(mode.size(), nodes)) {
        const Eigen::VectorXd place = mode + factor * (2 * reach * (cell.array() - 0.5)).matrix();
        if (place.minCoeff() >= 0 && place.maxCoeff() <= 1) {
            grid.places.push_back(place);
            grid.nodes.push_back(evaluate(place));
        }
    }
    return grid;
}

}  // namespace coagula::diagnose
