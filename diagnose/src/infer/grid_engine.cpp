// SPDX-License-Identifier: GPL-3.0-or-later
// The engine by quadrature: where to lay a grid so that it sees the posterior.
#include "noise/quiet_log.hpp"
#include "posterior_grid.hpp"

#include <coagula/common/dense.hpp>
#include <coagula/common/log_probability.hpp>
#include <coagula/common/special_functions.hpp>

#include <ceres/cost_function.h>
#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace coagula::diagnose {

namespace {

using Eigen::Index;

/// Logarithms of the weight below the best node from which on one counts for nothing.
constexpr double negligible = 12;
/// From which on one may lie outside of a normal posterior.
constexpr double light = 9;
constexpr int drawn = 64;

/// Whether a grid about the mode sees more of a narrow ridge than one along the axes, which misses its crest or sees it at few
/// nodes. At the edge of the prior it may see less.
bool sees_more(const PosteriorGrid& about, const PosteriorGrid& along) {
    // What a grid along the axes lacks at its best node, for each axis, where it misses the crest: beside a mode that is no ridge
    // it lies by half a cell of each at most, which is less.
    constexpr double missed = 1.5;
    if (about.nodes.empty()) {
        return false;
    }
    const double gain = about.nodes[about.best()].log_weight - along.nodes[along.best()].log_weight;
    if (gain > missed * static_cast<double>(along.half_widths.size())) {
        return true;
    }
    const bool has_more = !along.is_fine() && about.effective_nodes() > along.effective_nodes();
    const bool goes_beyond = along.cut && about.is_fine();
    return gain > -1 && (!along.resolves_axes() || has_more || goes_beyond);
}

/// Whether a grid about the mode holds all of the posterior that one over the whole prior sees.
bool holds(const PosteriorGrid& about, const PosteriorGrid& whole) {
    if (about.nodes.empty() || about.clipped || !about.is_fine()) {
        return false;
    }
    const double highest = about.nodes[about.best()].log_weight;
    for (std::size_t k = 0; k < whole.nodes.size(); ++k) {
        if (whole.nodes[k].log_weight > highest - light && !about.reaches(whole.places[k])) {
            return false;
        }
    }
    return true;
}

/// Residuals of a problem by the places of the parameters, stiffness, sample effects and errors of the model at their best for
/// these: what those move is projected out (Kaufman, BIT 15 (1975) 49).
class BestResiduals : public ceres::CostFunction {
public:
    BestResiduals(const Problem& problem, const Eigen::VectorXd& start, const EvaluateNode& evaluate)
        : problem_(problem), evaluate_(evaluate) {
        mutable_parameter_block_sizes()->push_back(static_cast<int>(start.size()));
        set_num_residuals(static_cast<int>(at(start).residual.size()));
    }

    bool Evaluate(const double* const* places, double* residuals, double** jacobians) const override {
        const ProjectedResidual here = at(Eigen::Map<const Eigen::VectorXd>(places[0], problem_.axes()));
        Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = here.residual;
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<RowMajor>(jacobians[0], num_residuals(), problem_.axes()) = here.slopes;
        }
        return true;
    }

private:
    ProjectedResidual at(const Eigen::VectorXd& place) const { return problem_.residual(place, evaluate_(place).log_stiffness); }

    const Problem& problem_;
    const EvaluateNode& evaluate_;
};

/// Least squares from a place of the prior, kept inside it; then the grid about what it finds, by the covariance there. None where
/// not all parameters are determined.
std::optional<PosteriorGrid> grid_about_mode(const Problem& problem, Eigen::VectorXd place, const EvaluateNode& evaluate) {
    const QuietLog quiet;
    const Index axes = place.size();
    ceres::Problem least_squares;
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
    least_squares.AddResidualBlock(new BestResiduals(problem, place, evaluate), nullptr, place.data());
    for (int axis = 0; axis < static_cast<int>(axes); ++axis) {
        place[axis] = std::clamp(place[axis], prior_edge, 1 - prior_edge);
        least_squares.SetParameterLowerBound(place.data(), axis, prior_edge);
        least_squares.SetParameterUpperBound(place.data(), axis, 1 - prior_edge);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 30;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &least_squares, &summary);

    ceres::Covariance::Options by_values;
    by_values.algorithm_type = ceres::DENSE_SVD;
    by_values.null_space_rank = -1;  // what is not determined has no variance then
    by_values.min_reciprocal_condition_number = 1e-13;
    ceres::Covariance covariance(by_values);
    Eigen::MatrixXd matrix(axes, axes);
    if (!summary.IsSolutionUsable() || !covariance.Compute(std::vector<const double*>{place.data()}, &least_squares) ||
        !covariance.GetCovarianceBlock(place.data(), place.data(), matrix.data())) {
        return std::nullopt;
    }
    // What the data hardly determine, the prior does.
    constexpr double variance_of_prior = 1.0 / 12;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(axes, axes);
    const Eigen::MatrixXd with_prior = dense::solve(identity + matrix / variance_of_prior, matrix);
    const Eigen::LLT<Eigen::MatrixXd> root(0.5 * (with_prior + with_prior.transpose()));
    if (root.info() != Eigen::Success || root.rcond() < 1e-13) {
        return std::nullopt;
    }
    return grid_about(place, root.matrixL(), evaluate);
}

PosteriorGrid grid_of(const Problem& problem) {
    double start = problem.log_stiffness;
    double best = -std::numeric_limits<double>::infinity();
    bool knows_start = false;
    const auto evaluate = [&](const Eigen::VectorXd& place) {
        const Node node = problem.node(place, knows_start ? start : problem.start(place, start), best - negligible);
        best = std::max(best, node.log_weight);
        start = node.log_weight > best - negligible ? node.log_stiffness : start;
        return node;
    };
    const Index axes = problem.axes();
    ClosingGrid closing(axes, evaluate);
    knows_start = true;
    const PosteriorGrid& grid = closing.grid();
    if (axes == 0) {
        return grid;
    }
    const bool is_flat = closing.is_settled();
    std::optional<PosteriorGrid> about;
    const auto look_about_mode = [&] {
        const double highest = grid.nodes[grid.best()].log_weight;
        if (axes > 1 && !is_flat && (!about || about->nodes[about->best()].log_weight < highest)) {
            about = grid_about_mode(problem, grid.places[grid.best()], evaluate);
        }
    };
    if (!grid.is_fine()) {  // of a narrow posterior the mode is found sooner than the box
        look_about_mode();
        if (about && holds(*about, grid)) {
            return *about;
        }
    }
    // Along several axes every round is dear, and the mode soon near enough to be found.
    constexpr int few_rounds = 3;
    const int more_rounds = axes > 1 ? 2 : 4;
    closing.close_in(few_rounds);
    look_about_mode();
    if (!closing.is_settled() && !(about && about->is_fine() && sees_more(*about, grid))) {
        closing.close_in(more_rounds);
        look_about_mode();
    }
    if (about && sees_more(*about, grid)) {
        return about->is_fine() ? *about : refined(*about, evaluate);
    }
    closing.refine(axes > 1 ? 1 : 2);
    return grid;
}

/// The highest of the nodes, or between them where a parabola through these leads higher.
std::pair<Eigen::VectorXd, Node> most_probable(const Problem& problem, const PosteriorGrid& grid) {
    const std::size_t best = grid.best();
    const auto rounded = [&](Eigen::VectorXd place) {
        for (Index axis = 0; axis < place.size(); ++axis) {
            place[axis] = problem.priors[static_cast<std::size_t>(axis) + 1].rounded(place[axis]);
        }
        return place;
    };
    const auto at = [&](const Eigen::VectorXd& place) {
        return place == grid.places[best]
                   ? grid.nodes[best]
                   : problem.node(place, grid.nodes[best].log_stiffness, -std::numeric_limits<double>::infinity());
    };
    const Eigen::VectorXd at_node = rounded(grid.places[best]);
    const std::optional<Eigen::VectorXd> peak = problem.axes() == 0 ? std::nullopt : grid.peak();
    const Eigen::VectorXd between = peak ? rounded(*peak) : at_node;
    const Node node = at(at_node);
    if (between == at_node) {
        return {at_node, node};
    }
    const Node higher = at(between);
    return higher.log_weight > node.log_weight ? std::pair(between, higher) : std::pair(at_node, node);
}

/// Draws at equal steps of the cumulated probability.
PosteriorDraws draws_from(const PosteriorGrid& grid, const Problem& problem) {
    const std::vector<double> probability = probabilities_of(grid.log_weights());
    PosteriorDraws draws(problem.axes() + 1, drawn);
    double below = 0;
    std::size_t number = 0;
    for (int draw = 0; draw < drawn; ++draw) {
        while (number + 1 < grid.nodes.size() && below + probability[number] < (draw + 0.5) / drawn) {
            below += probability[number++];
        }
        const double part = std::fmod((draw + 0.5) * std::numbers::phi, 1.0);  // apart from that of the node
        const double departure = normal_quantile(part);
        draws(0, draw) = std::exp(grid.nodes[number].log_stiffness + grid.nodes[number].deviation * departure);
        for (Index axis = 0; axis < problem.axes(); ++axis) {
            draws(axis + 1, draw) = problem.priors[static_cast<std::size_t>(axis) + 1].at(grid.places[number][axis]);
        }
    }
    return draws;
}

}  // namespace

Engine grid() {
    return [](const Problem& problem) {
        const auto nodes = std::make_shared<const PosteriorGrid>(grid_of(problem));
        auto [place, node] = most_probable(problem, *nodes);
        return Posterior{.place = std::move(place),
                         .node = node,
                         .log_evidence = nodes->log_evidence(),
                         .draws = draws_from(*nodes, problem),
                         .quantile = [nodes](Index axis, double part) { return nodes->quantile(axis, part); },
                         .log_stiffness_quantile =
                             [nodes](double part, double further) { return nodes->log_stiffness_quantile(part, further); }};
    };
}

}  // namespace coagula::diagnose
