// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/heterogeneity.hpp>

#include <Eigen/LU>
#include <unsupported/Eigen/NonLinearOptimization>

#include <cmath>
#include <numbers>

namespace coagula::characterize {

namespace {

/// Residuals P_k - [1 - erf((x_k - b) / (a sqrt 2))] as functions of (a, b), in the form that Eigen's solver asks for.
struct ErrorFunctionResiduals {
    const Eigen::VectorXd& x;
    const Eigen::VectorXd& probability;

    int values() const { return static_cast<int>(x.size()); }

    int operator()(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals) const {
        const double scale = 1 / (parameters[0] * std::numbers::sqrt2);
        for (Index k = 0; k < x.size(); ++k) {
            residuals[k] = probability[k] - std::erfc((x[k] - parameters[1]) * scale);
        }
        return 0;
    }

    int df(const Eigen::VectorXd& parameters, Eigen::MatrixXd& jacobian) const {
        const double a = parameters[0];
        for (Index k = 0; k < x.size(); ++k) {
            const double z = (x[k] - parameters[1]) / a;
            const double slope = -std::sqrt(2 / std::numbers::pi) * std::exp(-0.5 * z * z) / a;
            jacobian(k, 0) = slope * z;
            jacobian(k, 1) = slope;
        }
        return 0;
    }
};

void add_standard_errors(const ErrorFunctionResiduals& model, const Eigen::VectorXd& parameters, DegreeOfHeterogeneity& fit) {
    const Index count = model.x.size();
    Eigen::VectorXd residuals(count);
    Eigen::MatrixXd jacobian(count, 2);
    model(parameters, residuals);
    model.df(parameters, jacobian);
    const double squares = residuals.squaredNorm();
    const Eigen::Matrix2d normal = jacobian.transpose() * jacobian;
    const Eigen::Matrix2d covariance = normal.inverse() * (squares / static_cast<double>(count - 2));
    fit.a_stderr = std::sqrt(covariance(0, 0));
    fit.b_stderr = std::sqrt(covariance(1, 1));
    fit.rms_residual = std::sqrt(squares / static_cast<double>(count));
}

}  // namespace

DegreeOfHeterogeneity fit_degree_of_heterogeneity(const PoreSizes& pores, double r0, double lowest_probability) {
    require_positive(r0, "the radius that makes pore sizes dimensionless", "m");
    require(pores.radius.size() >= 4 && pores.radius.size() == pores.exclusion_probability.size() && pores.radius.allFinite() &&
                pores.exclusion_probability.allFinite() && pores.mean > 0,
            "the degree of heterogeneity needs a pore-size curve of at least four finite points and a positive mean");
    const Index fitted = (pores.exclusion_probability.array() >= lowest_probability).count();  // P falls with r
    require(fitted >= 4, "the degree of heterogeneity needs at least four radii with P >= " + to_text(lowest_probability) +
                             ", and the curve has " + std::to_string(fitted) + ": ask for more radii");
    const Eigen::VectorXd x = pores.radius.head(fitted) / r0;
    const Eigen::VectorXd probability = pores.exclusion_probability.head(fitted);
    const ErrorFunctionResiduals model{x, probability};
    // Start from the half normal distribution (b = 0) with the same mean.
    Eigen::VectorXd parameters(2);
    parameters << pores.mean / r0 * std::sqrt(std::numbers::pi / 2), 0.0;
    Eigen::LevenbergMarquardt<const ErrorFunctionResiduals> solver(model);
    solver.parameters.ftol = solver.parameters.xtol = 1e-13;
    const auto status = solver.minimize(parameters);
    if (status <= 0 || status == Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation || !parameters.allFinite() ||
        parameters[0] <= 0) {
        throw std::runtime_error("the error function could not be fitted to the pore-size curve");
    }
    DegreeOfHeterogeneity fit;
    fit.a = parameters[0];
    fit.b = parameters[1];
    fit.iterations = static_cast<int>(solver.iter);
    add_standard_errors(model, parameters, fit);
    return fit;
}

}  // namespace coagula::characterize
