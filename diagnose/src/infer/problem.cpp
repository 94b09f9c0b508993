// SPDX-License-Identifier: GPL-3.0-or-later
// An inference states the problem that an engine solves.
#include "departures.hpp"
#include "hypothesis.hpp"

#include <cmath>
#include <utility>

namespace coagula::diagnose {

Problem Inference::problem(const Hypothesis& hypothesis) const {
    const double lowest = log_level_ - 0.5 * log_stiffness_range;
    const auto model = [hypothesis, lowest](const Eigen::VectorXd& place) {
        return model_at(hypothesis, place.tail(place.size() - 1), std::exp(lowest + place[0] * log_stiffness_range));
    };
    std::vector<MechanismParameter> priors{
        {"normal_stiffness", "N/m", std::exp(lowest), std::exp(lowest + log_stiffness_range), true}};
    const std::vector<MechanismParameter> of_causes = parameters_of(hypothesis);
    priors.insert(priors.end(), of_causes.begin(), of_causes.end());
    return {.priors = std::move(priors),
            .log_stiffness = log_level_,
            .log_density =
                [this, model](const Eigen::VectorXd& place) {
                    const Model here = model(place);
                    return density_at(here, std::log(here.settings.normal_stiffness)) + std::log(log_stiffness_range);
                },
            .start = [this, hypothesis](const Eigen::VectorXd& at,
                                        double before) { return better_start(model_at(hypothesis, at, 1), before); },
            .node =
                [this, hypothesis](const Eigen::VectorXd& at, double start, double least) {
                    const Node found = best_stiffness(model_at(hypothesis, at, 1), start, least);
                    return hypothesis.empty() ? highest_of_base(found) : found;
                },
            .residual = [this, hypothesis](const Eigen::VectorXd& at,
                                           double log_stiffness) { return projected_residual(hypothesis, at, log_stiffness); }};
}

ProjectedResidual Inference::projected_residual(const Hypothesis& hypothesis, const Eigen::VectorXd& place,
                                                double log_stiffness) const {
    const Fit fit{
        .hypothesis = hypothesis, .model = model_at(hypothesis, place, std::exp(log_stiffness)), .parameters = {}, .draws = {}};
    const Departures departures = departures_of(*this, fit);
    const Eigen::MatrixXd& all = departures.jacobian;
    Eigen::MatrixXd others(all.rows(), all.cols() - place.size());
    others << all.col(0), all.rightCols(all.cols() - 1 - place.size());
    const Eigen::MatrixXd basis = orthonormal_basis(others);
    const auto project = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
        return columns - basis * (basis.transpose() * columns);
    };
    return {project(departures.residual), -project(all.middleCols(1, place.size()))};
}

}  // namespace coagula::diagnose
