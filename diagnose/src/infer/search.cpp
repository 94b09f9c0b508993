// SPDX-License-Identifier: GPL-3.0-or-later
// The search for the posterior of a hypothesis.
#include "departures.hpp"
#include "hypothesis.hpp"
#include "noise/quiet_log.hpp"

#include <coagula/common/dense.hpp>

#include <ceres/cost_function.h>
#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace coagula::diagnose {

namespace {

/// Logarithms of the weight below the best node from which on one counts for nothing.
constexpr double negligible = 12;
/// From which on one may lie outside of a normal posterior.
constexpr double light = 9;

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

}  // namespace

/// Whitened residuals by the places of the parameters in their priors, stiffness, sample effects and errors of the model at their
/// best for these: what those move is projected out (Kaufman, BIT 15 (1975) 49).
class Inference::ProjectedResiduals : public ceres::CostFunction {
public:
    ProjectedResiduals(const Inference& inference, const Hypothesis& hypothesis, const Eigen::VectorXd& start,
                       const EvaluateNode& evaluate)
        : inference_(inference), hypothesis_(hypothesis), evaluate_(evaluate) {
        mutable_parameter_block_sizes()->push_back(static_cast<int>(start.size()));
        set_num_residuals(static_cast<int>(departures_at(start).residual.size()));
    }

    bool Evaluate(const double* const* places, double* residuals, double** jacobians) const override {
        const Index axes = parameter_block_sizes().front();
        const Departures departures = departures_at(Eigen::Map<const Eigen::VectorXd>(places[0], axes));
        const Eigen::MatrixXd& all = departures.jacobian;
        Eigen::MatrixXd others(all.rows(), all.cols() - axes);
        others << all.col(0), all.rightCols(all.cols() - 1 - axes);
        const Eigen::MatrixXd basis = orthonormal_basis(others);
        const auto project = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
            return columns - basis * (basis.transpose() * columns);
        };
        Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = project(departures.residual);
        if (jacobians != nullptr && jacobians[0] != nullptr) {
            using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
            Eigen::Map<RowMajor>(jacobians[0], num_residuals(), axes) = -project(all.middleCols(1, axes));
        }
        return true;
    }

private:
    Departures departures_at(const Eigen::VectorXd& place) const {
        Fit fit{.hypothesis = hypothesis_,
                .model = model_at(hypothesis_, place, std::exp(evaluate_(place).log_stiffness)),
                .parameters = {},
                .draws = {}};
        return departures_of(inference_, fit);
    }

    const Inference& inference_;
    const Hypothesis& hypothesis_;
    const EvaluateNode& evaluate_;
};

/// Least squares from a place of the prior, kept inside it; then the grid about what it finds, by the covariance there. None where
/// not all parameters are determined.
std::optional<PosteriorGrid> Inference::grid_about_mode(const Hypothesis& hypothesis, Eigen::VectorXd place,
                                                        const EvaluateNode& evaluate) const {
    const QuietLog quiet;
    const Index axes = place.size();
    ceres::Problem problem;
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
    problem.AddResidualBlock(new ProjectedResiduals(*this, hypothesis, place, evaluate), nullptr, place.data());
    for (int axis = 0; axis < static_cast<int>(axes); ++axis) {
        place[axis] = std::clamp(place[axis], prior_edge, 1 - prior_edge);
        problem.SetParameterLowerBound(place.data(), axis, prior_edge);
        problem.SetParameterUpperBound(place.data(), axis, 1 - prior_edge);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 30;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);

    ceres::Covariance::Options by_values;
    by_values.algorithm_type = ceres::DENSE_SVD;
    by_values.null_space_rank = -1;  // what is not determined has no variance then
    by_values.min_reciprocal_condition_number = 1e-13;
    ceres::Covariance covariance(by_values);
    Eigen::MatrixXd matrix(axes, axes);
    if (!summary.IsSolutionUsable() || !covariance.Compute(std::vector<const double*>{place.data()}, &problem) ||
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

PosteriorGrid Inference::posterior(const Hypothesis& hypothesis) const {
    double start = log_level_;
    double best = -std::numeric_limits<double>::infinity();
    bool knows_start = false;
    const auto evaluate = [&](const Eigen::VectorXd& place) {
        const Model model = model_at(hypothesis, place, 1);
        const Node node = best_stiffness(model, knows_start ? start : better_start(model, start), best - negligible);
        best = std::max(best, node.log_weight);
        start = node.log_weight > best - negligible ? node.log_stiffness : start;
        return node;
    };
    const auto axes = static_cast<Index>(parameters_of(hypothesis).size());
    ClosingGrid closing(axes, evaluate);
    knows_start = true;
    const PosteriorGrid& grid = closing.grid();
    if (axes == 0) {
        PosteriorGrid base = grid;
        base.nodes.front() = highest_of_base(base.nodes.front());
        return base;
    }
    const bool is_flat = closing.is_settled();
    std::optional<PosteriorGrid> about;
    const auto look_about_mode = [&] {
        const double highest = grid.nodes[grid.best()].log_weight;
        if (axes > 1 && !is_flat && (!about || about->nodes[about->best()].log_weight < highest)) {
            about = grid_about_mode(hypothesis, grid.places[grid.best()], evaluate);
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

}  // namespace coagula::diagnose
