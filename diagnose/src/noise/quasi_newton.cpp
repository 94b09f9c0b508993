// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasi_newton.hpp"

#include "quiet_log.hpp"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/numeric_diff_first_order_function.h>

#include <cmath>

namespace coagula::diagnose {

namespace {

Deviations product(const double* at, const Deviations& units) {
    return {at[0] * units[0], at[1] * units[1], at[2] * units[2]};
}

struct Cost {
    const std::function<double(const Deviations&)>& function;
    const Deviations& units;

    bool operator()(const double* at, double* value) const {
        *value = function(product(at, units));
        return std::isfinite(*value);
    }
};

}  // namespace

Deviations minimum_of(const std::function<double(const Deviations&)>& function, const Deviations& start, const Deviations& units) {
    const QuietLog quiet;
    const ceres::GradientProblem problem(
        new ceres::NumericDiffFirstOrderFunction<Cost, ceres::CENTRAL, 3>(new Cost{function, units}));
    ceres::GradientProblemSolver::Options options;
    options.line_search_direction_type = ceres::BFGS;
    options.function_tolerance = 1e-10;
    options.max_num_iterations = 200;
    options.logging_type = ceres::SILENT;
    ceres::GradientProblemSolver::Summary summary;
    Deviations at{start[0] / units[0], start[1] / units[1], start[2] / units[2]};
    ceres::Solve(options, problem, at.data(), &summary);
    return product(at.data(), units);
}

}  // namespace coagula::diagnose
