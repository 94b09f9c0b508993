// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes where a posterior is evaluated.
#pragma once

#include "problem.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// Distance from the ends of a prior, 0 .. 1, that fits by straight lines keep.
inline constexpr double prior_edge = 1e-3;

using EvaluateNode = std::function<Node(const Eigen::VectorXd& place)>;

/// Nodes of equal volume.
struct PosteriorGrid {
    std::vector<Eigen::VectorXd> places;
    std::vector<Node> nodes;
    double log_cell = 0;
    Eigen::MatrixXd cell;         ///< edges of a cell, one per column, lower triangular
    Eigen::VectorXd half_widths;  ///< of a cell along each axis
    Eigen::VectorXd mode;         ///< about which the nodes lie, if they do about one
    Eigen::MatrixXd factor;       ///< of the covariance there, lower triangular
    bool clipped = false;         ///< the prior ends before that normal posterior does
    bool cut = false;             ///< its box ends where the posterior does not, inside the prior
    std::vector<int> along = {};  ///< nodes along each axis, the first axis fastest; empty: those about a mode

    std::vector<double> log_weights() const;
    std::size_t best() const;
    double log_evidence() const;
    /// Number of nodes of equal weight that would say as much: few where the grid is too coarse.
    double effective_nodes() const;
    /// Whether these are enough for its quantiles.
    bool is_fine() const;
    /// Whether along each axis the nodes vary by enough: @param enough variance over the square of a cell.
    std::vector<bool> resolved_axes(double enough) const;
    /// Whether along every axis the posterior is about as wide as a cell or wider, by its standard deviation.
    bool resolves_axes() const;
    /// Mean and covariance of the nodes' places.
    std::pair<Eigen::VectorXd, Eigen::MatrixXd> moments() const;
    /// Whether nodes about the mode lie about this place, too.
    bool reaches(const Eigen::VectorXd& place) const;
    /// Place along an axis below which a part of the probability lies: between nodes along the axes the logarithm of the density
    /// is a parabola through the three nearest ones.
    double quantile(Eigen::Index axis, double part) const;
    /// The place where a parabola through the best node and the nodes about it is highest, at most a cell from that node; none
    /// where it has no maximum.
    std::optional<Eigen::VectorXd> peak() const;
    /// Logarithm of the stiffness below which a part of the probability lies, whatever the place.
    /// @param further standard deviation that no node knows of.
    double log_stiffness_quantile(double part, double further) const;
};

/// A grid along the axes, first a coarse one over the whole prior, that closes in on where the posterior is.
class ClosingGrid {
public:
    ClosingGrid(Eigen::Index axes, EvaluateNode evaluate);

    /// Fills it anew, at most so many times, until it does not change any more.
    void close_in(int rounds);
    /// Fills it anew, at most so many times, with as many nodes along each axis as there may be, until the nodes and parabolas
    /// between them tell its quantiles.
    void refine(int rounds);
    /// From the start where the posterior hardly differs from the prior.
    bool is_settled() const { return settled_; }

    const PosteriorGrid& grid() const { return grid_; }

private:
    void fill(const std::vector<int>& along);
    std::vector<int> nodes_of_box() const;
    std::pair<Eigen::ArrayXd, Eigen::ArrayXd> box_of_posterior() const;
    using Ends = Eigen::Array<bool, Eigen::Dynamic, 1>;  ///< one of each axis
    std::pair<Ends, Ends> cut_ends() const;

    EvaluateNode evaluate_;
    Eigen::ArrayXd low_;  ///< corners of the part of the prior that it fills
    Eigen::ArrayXd high_;
    PosteriorGrid grid_;
    bool is_box_ = false;  ///< no grid over the whole prior any more
    bool settled_ = false;
};

/// A grid along the principal axes of a normal posterior, as far as that reaches, clipped to the prior.
/// @param factor of its covariance, lower triangular.
PosteriorGrid grid_about(const Eigen::VectorXd& mode, const Eigen::MatrixXd& factor, const EvaluateNode& evaluate);

/// The same about the mean of a grid of which few nodes count, by the covariance of its nodes.
PosteriorGrid refined(const PosteriorGrid& grid, const EvaluateNode& evaluate);

/// Where the middle part of a normal distribution ends of which only what the prior allows, 0 .. 1, is left.
std::pair<double, double> middle_within_prior(double mean, double deviation, double part);

}  // namespace coagula::diagnose
