// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes where a posterior is evaluated.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// What is known at one place of the prior, 0 .. 1 along each axis, the stiffness integrated out.
struct Node {
    double log_stiffness = 0;
    double deviation = 0;    ///< of log_stiffness
    double log_density = 0;  ///< at the best stiffness
    double log_weight = 0;   ///< stiffness integrated out
};

using EvaluateNode = std::function<Node(const Eigen::VectorXd& place)>;

/// Nodes of equal volume.
struct PosteriorGrid {
    std::vector<Eigen::VectorXd> places;
    std::vector<Node> nodes;
    double log_cell = 0;
    Eigen::VectorXd half_widths;  ///< of a cell along each axis
    Eigen::VectorXd mode;         ///< about which the nodes lie, if they do about one
    Eigen::MatrixXd factor;       ///< of the covariance there, lower triangular
    bool clipped = false;         ///< the prior ends before that normal posterior does

    std::size_t best() const;
    double log_evidence() const;
    /// Number of nodes of equal weight that would say as much: few where the grid is too coarse.
    double effective_nodes() const;
    /// Whether these are enough for its quantiles.
    bool is_fine() const;
    /// Whether along every axis the posterior is about as wide as a cell or wider, by its standard deviation.
    bool resolves_axes() const;
    /// Whether nodes about the mode lie about this place, too.
    bool reaches(const Eigen::VectorXd& place) const;
    /// Place along an axis below which a part of the probability lies.
    double quantile(Eigen::Index axis, double part) const;
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
    /// From the start where the posterior hardly differs from the prior.
    bool is_settled() const { return settled_; }

    const PosteriorGrid& grid() const { return grid_; }

private:
    void fill(const std::vector<int>& along);
    std::vector<int> nodes_of_box() const;
    std::pair<Eigen::ArrayXd, Eigen::ArrayXd> box_of_posterior() const;

    EvaluateNode evaluate_;
    Eigen::ArrayXd low_;  ///< corners of the part of the prior that it fills
    Eigen::ArrayXd high_;
    std::vector<int> along_;  ///< nodes along each axis
    PosteriorGrid grid_;
    bool is_box_ = false;  ///< no grid over the whole prior any more
    bool settled_ = false;
};

/// A grid along the principal axes of a normal posterior, as far as that reaches, clipped to the prior.
/// @param factor of its covariance, lower triangular.
PosteriorGrid grid_about(const Eigen::VectorXd& mode, const Eigen::MatrixXd& factor, const EvaluateNode& evaluate);

}  // namespace coagula::diagnose
