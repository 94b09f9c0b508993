// SPDX-License-Identifier: GPL-3.0-or-later
#include "posterior_grid.hpp"

#include <coagula/common/log_probability.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

using Eigen::Index;

constexpr double relevant = 14;  // logarithms below the best node that count
constexpr double heavy = 6;      // logarithms below the best node that are not to lie at the edge of the grid
constexpr double reach = 5;      // standard deviations
constexpr double smooth = 1.5;   // logarithms from node to node: its square over 24 is what the evidence may err by
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Nodes along an axis for so many axes.
struct NodesAlong {
    int first;  ///< over the whole prior, enough where the posterior hardly differs from it
    int whole;  ///< over the whole prior, to see where the posterior is
    int box;    ///< over a box about the posterior
    int mode;   ///< along the principal axes about a mode
};

NodesAlong nodes_for(Index axes) {
    constexpr std::array<NodesAlong, 5> nodes{{{1, 1, 1, 1}, {11, 41, 31, 15}, {5, 13, 15, 15}, {4, 7, 8, 9}, {3, 5, 6, 7}}};
    return nodes.at(std::min(static_cast<std::size_t>(axes), nodes.size() - 1));
}

/// Every node of a grid, as middles of cells 0 .. 1 along each axis.
std::vector<Eigen::VectorXd> middles(const std::vector<int>& along) {
    std::size_t count = 1;
    for (const int nodes : along) {
        count *= static_cast<std::size_t>(nodes);
    }
    std::vector<Eigen::VectorXd> all;
    for (std::size_t number = 0; number < count; ++number) {
        Eigen::VectorXd place(static_cast<Index>(along.size()));
        std::size_t rest = number;
        for (std::size_t axis = 0; axis < along.size(); ++axis) {
            const auto nodes = static_cast<std::size_t>(along[axis]);
            place[static_cast<Index>(axis)] = (static_cast<double>(rest % nodes) + 0.5) / static_cast<double>(nodes);
            rest /= nodes;
        }
        all.push_back(std::move(place));
    }
    return all;
}

/// Largest difference of log weights between neighbours along each axis, one of them less than `depth` below the best node.
std::vector<double> roughness(const std::vector<Node>& nodes, const std::vector<int>& along, double depth) {
    const auto lower = [](const Node& a, const Node& b) { return a.log_weight < b.log_weight; };
    const double least = std::max_element(nodes.begin(), nodes.end(), lower)->log_weight - depth;
    std::vector<double> largest;
    std::size_t stride = 1;
    for (const int count : along) {
        largest.push_back(0);
        for (std::size_t k = 0; k + stride < nodes.size(); ++k) {
            const double here = nodes[k].log_weight;
            const double next = nodes[k + stride].log_weight;
            const bool neighbours = k / stride % static_cast<std::size_t>(count) + 1 < static_cast<std::size_t>(count);
            if (neighbours && std::max(here, next) > least) {
                largest.back() = std::max(largest.back(), std::abs(next - here));
            }
        }
        stride *= static_cast<std::size_t>(count);
    }
    return largest;
}

/// A cell of a grid that stands askew in the prior.
class CutCell {
public:
    /// @param edges of a cell, one per column.
    explicit CutCell(const Eigen::MatrixXd& edges) : reach_(0.5 * edges.cwiseAbs().rowwise().sum()) {
        constexpr int parts = 3;  // along each edge
        for (const Eigen::VectorXd& part : middles(std::vector<int>(static_cast<std::size_t>(edges.cols()), parts))) {
            parts_.emplace_back(edges * (part.array() - 0.5).matrix());
        }
    }

    /// Where the middle of that part of the cell lies that the prior holds, and how large that is.
    std::pair<Eigen::VectorXd, double> inside_prior(const Eigen::VectorXd& middle) const {
        if ((middle - reach_).minCoeff() >= 0 && (middle + reach_).maxCoeff() <= 1) {
            return {middle, 1};
        }
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(middle.size());
        double count = 0;
        for (const Eigen::VectorXd& part : parts_) {
            const Eigen::VectorXd place = middle + part;
            if (place.minCoeff() >= 0 && place.maxCoeff() <= 1) {
                sum += place;
                ++count;
            }
        }
        return {count > 0 ? Eigen::VectorXd(sum / count) : middle, count / static_cast<double>(parts_.size())};
    }

private:
    Eigen::VectorXd reach_;  ///< of a cell along the axes of the prior, from its middle
    std::vector<Eigen::VectorXd> parts_;
};

}  // namespace

std::vector<double> PosteriorGrid::log_weights() const {
    std::vector<double> weights;
    for (const Node& node : nodes) {
        weights.push_back(node.log_weight);
    }
    return weights;
}

std::size_t PosteriorGrid::best() const {
    const auto found =
        std::max_element(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) { return a.log_weight < b.log_weight; });
    return static_cast<std::size_t>(found - nodes.begin());
}

double PosteriorGrid::log_evidence() const {
    return log_sum(log_weights()) + log_cell;
}

double PosteriorGrid::effective_nodes() const {
    double squares = 0;
    for (const double probability : probabilities_of(log_weights())) {
        squares += probability * probability;
    }
    return 1 / squares;
}

bool PosteriorGrid::reaches(const Eigen::VectorXd& place) const {
    return factor.triangularView<Eigen::Lower>().solve(place - mode).norm() <= reach;
}

std::vector<bool> PosteriorGrid::resolved_axes(double enough) const {
    const Eigen::ArrayXd variance = moments().second.diagonal();
    const Eigen::Array<bool, Eigen::Dynamic, 1> resolved = variance >= enough * (2 * half_widths).array().square();
    return {resolved.begin(), resolved.end()};
}

bool PosteriorGrid::resolves_axes() const {
    constexpr double enough = 0.65;  // three nodes of equal weight have two thirds
    const std::vector<bool> resolved = resolved_axes(enough);
    return std::find(resolved.begin(), resolved.end(), false) == resolved.end();
}

std::pair<Eigen::VectorXd, Eigen::MatrixXd> PosteriorGrid::moments() const {
    const std::vector<double> probability = probabilities_of(log_weights());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(half_widths.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        mean += probability[k] * places[k];
    }
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(mean.size(), mean.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const Eigen::VectorXd away = places[k] - mean;
        covariance += probability[k] * away * away.transpose();
    }
    return {std::move(mean), std::move(covariance)};
}

bool PosteriorGrid::is_fine() const {
    constexpr double enough = 2.5;  // per axis
    return effective_nodes() >= std::pow(enough, static_cast<double>(half_widths.size()));
}

ClosingGrid::ClosingGrid(Index axes, EvaluateNode evaluate)
    : evaluate_(std::move(evaluate)), low_(Eigen::ArrayXd::Zero(axes)), high_(Eigen::ArrayXd::Ones(axes)) {
    const auto count = static_cast<std::size_t>(axes);
    const NodesAlong nodes = nodes_for(axes);
    fill(std::vector<int>(count, nodes.first));
    const std::vector<double> rough = roughness(grid_.nodes, grid_.along, infinite);
    settled_ = std::all_of(rough.begin(), rough.end(), [](double one) { return one < smooth; });
    if (!settled_) {
        fill(std::vector<int>(count, nodes.whole));
    }
}

void ClosingGrid::fill(const std::vector<int>& along) {
    const Index axes = low_.size();
    grid_ = {};
    grid_.along = along;
    for (const Eigen::VectorXd& cell : middles(along)) {
        grid_.places.emplace_back((low_ + (high_ - low_) * cell.array()).matrix());
        grid_.nodes.push_back(evaluate_(grid_.places.back()));
    }
    const Eigen::ArrayXd width = (high_ - low_) / Eigen::ArrayXi::Map(along.data(), axes).cast<double>();
    grid_.log_cell = width.log().sum();
    grid_.cell = width.matrix().asDiagonal();
    grid_.half_widths = (0.5 * width).matrix();
    const auto [lower, upper] = cut_ends();
    grid_.cut = lower.any() || upper.any();
}

/// At which ends of the box, but not of the prior, a node has a noticeable part of the largest weight: lower and upper ones.
std::pair<ClosingGrid::Ends, ClosingGrid::Ends> ClosingGrid::cut_ends() const {
    constexpr double noticeable = 3;  // logarithms below the best node
    const Eigen::ArrayXd width = 2 * grid_.half_widths.array();
    const double least = grid_.nodes[grid_.best()].log_weight - noticeable;
    Ends lower = Ends::Constant(width.size(), false);
    Ends upper = lower;
    for (std::size_t k = 0; k < grid_.nodes.size(); ++k) {
        if (grid_.nodes[k].log_weight > least) {
            const Eigen::ArrayXd place = grid_.places[k].array();
            lower = lower || (place < low_ + width && low_ > 0);
            upper = upper || (place > high_ - width && high_ < 1);
        }
    }
    return {lower, upper};
}

/// Few along axes along which the posterior hardly varies, and the more along the others.
std::vector<int> ClosingGrid::nodes_of_box() const {
    const std::vector<double> rough = roughness(grid_.nodes, grid_.along, heavy);
    const auto narrow = std::count_if(rough.begin(), rough.end(), [](double one) { return one >= smooth; });
    std::vector<int> along;
    for (const double one : rough) {
        along.push_back(one < smooth ? nodes_for(low_.size()).first : nodes_for(narrow).box);
    }
    return along;
}

void ClosingGrid::close_in(int rounds) {
    constexpr double same_size = 0.6;
    constexpr double same_evidence = 0.1;  // logarithms
    // Of a few nodes the evidence may stay by chance; what is not fine then, a grid about the mode may see.
    const double enough = 2.0 * static_cast<double>(low_.size());
    for (int round = 0; round < rounds && !settled_; ++round) {
        const auto [low, high] = box_of_posterior();
        const bool stays = (low >= low_).all() && (high <= high_).all() && ((high - low) > same_size * (high_ - low_)).all();
        settled_ = stays && !grid_.cut && (is_box_ || grid_.resolves_axes());
        if (!settled_) {
            const double before = grid_.log_evidence();
            const std::vector<int> along = nodes_of_box();
            low_ = low;
            high_ = high;
            fill(along);
            is_box_ = true;
            settled_ = std::abs(grid_.log_evidence() - before) < same_evidence && grid_.effective_nodes() > enough &&
                       grid_.resolves_axes() && !grid_.cut;
        }
    }
}

void ClosingGrid::refine(int rounds) {
    constexpr int most_nodes = 1000;
    constexpr double lost_peak = 0.5;  // logarithms
    constexpr double enough = 0.3;     // two nodes of equal weight have a quarter; with more, parabolas tell the rest
    for (int round = 0; round < rounds; ++round) {
        const std::vector<bool> resolved = grid_.resolved_axes(enough);
        const auto coarse = std::count(resolved.begin(), resolved.end(), false);
        if (coarse == 0) {
            return;
        }
        std::vector<int> along = nodes_of_box();
        for (std::size_t axis = 0; axis < along.size(); ++axis) {
            along[axis] = resolved[axis] ? along[axis] : std::max(along[axis], nodes_for(coarse).box);
        }
        if (std::accumulate(along.begin(), along.end(), 1, std::multiplies<>()) > most_nodes) {
            return;
        }
        const auto [low, high] = box_of_posterior();
        PosteriorGrid before = std::exchange(grid_, {});
        low_ = low;
        high_ = high;
        fill(along);
        is_box_ = true;
        // Nodes between which a narrow maximum falls tell less, however near they are.
        const double lost = before.nodes[before.best()].log_weight - grid_.nodes[grid_.best()].log_weight;
        if (lost > lost_peak && grid_.effective_nodes() < before.effective_nodes()) {
            grid_ = std::move(before);
            return;
        }
    }
}

/// Its lower and upper corner, about the nodes that count. A ridge between the nodes of a coarse grid may lead out of the box:
/// where that cuts the posterior, go beyond.
std::pair<Eigen::ArrayXd, Eigen::ArrayXd> ClosingGrid::box_of_posterior() const {
    const Eigen::ArrayXd width = 2 * grid_.half_widths.array();
    Eigen::ArrayXd low = Eigen::ArrayXd::Ones(width.size());
    Eigen::ArrayXd high = Eigen::ArrayXd::Zero(width.size());
    Eigen::ArrayXd lowest = low_;
    Eigen::ArrayXd highest = high_;
    const double largest = grid_.nodes[grid_.best()].log_weight;
    for (std::size_t k = 0; k < grid_.nodes.size(); ++k) {
        const Eigen::ArrayXd place = grid_.places[k].array();
        if (grid_.nodes[k].log_weight > largest - relevant) {
            low = low.min(place - 1.5 * width);
            high = high.max(place + 1.5 * width);
        }
        if (grid_.nodes[k].log_weight > largest - heavy) {
            lowest = (place < low_ + width).select(0.0, lowest);
            highest = (place > high_ - width).select(1.0, highest);
        }
    }
    // A cell at a time would take many rounds.
    const Eigen::ArrayXd much = 0.5 * (high_ - low_);
    const auto [lower, upper] = cut_ends();
    low = lower.select(low.min(low_ - much), low);
    high = upper.select(high.max(high_ + much), high);
    return {low.max(lowest), high.min(highest)};
}

PosteriorGrid grid_about(const Eigen::VectorXd& mode, const Eigen::MatrixXd& factor, const EvaluateNode& evaluate) {
    const int nodes = nodes_for(mode.size()).mode;
    const Eigen::MatrixXd edges = 2 * reach / nodes * factor;
    PosteriorGrid grid;
    grid.mode = mode;
    grid.factor = factor;
    grid.log_cell = edges.diagonal().array().abs().log().sum();
    grid.cell = edges;
    grid.half_widths = 0.5 * edges.rowwise().norm();
    const CutCell cut(edges);
    for (const Eigen::VectorXd& cell : middles(std::vector<int>(static_cast<std::size_t>(mode.size()), nodes))) {
        const Eigen::VectorXd departure = (2 * reach * (cell.array() - 0.5)).matrix();
        if (departure.norm() > reach) {
            continue;
        }
        const auto [place, share] = cut.inside_prior(mode + factor * departure);
        grid.clipped = grid.clipped || share < 1;
        if (share > 0) {
            grid.places.push_back(place);
            grid.nodes.push_back(evaluate(place));
            grid.nodes.back().log_weight += std::log(share);
        }
    }
    return grid;
}

PosteriorGrid refined(const PosteriorGrid& grid, const EvaluateNode& evaluate) {
    const auto [mean, covariance] = grid.moments();
    const Eigen::MatrixXd of_cells = grid.cell * grid.cell.transpose() / 12;
    PosteriorGrid finer = grid_about(mean, (covariance + of_cells).llt().matrixL(), evaluate);
    const double least = grid.nodes[grid.best()].log_weight - heavy;
    bool holds_all = !finer.nodes.empty() && finer.effective_nodes() > grid.effective_nodes();
    for (std::size_t k = 0; k < grid.nodes.size(); ++k) {
        holds_all = holds_all && (grid.nodes[k].log_weight < least || finer.reaches(grid.places[k]));
    }
    return holds_all ? finer : grid;
}

}  // namespace coagula::diagnose
