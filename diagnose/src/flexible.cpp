#include "flexible.hpp"

#include "smooth.hpp"

#include <Eigen/Cholesky>

#include <limits>

namespace coagula::diagnose {

namespace {

double log_normal_density(const Eigen::VectorXd& residual, const Eigen::LLT<Eigen::MatrixXd>& factor) {
    const Eigen::VectorXd white = factor.matrixL().solve(residual);
    return -0.5 * white.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known) {
    const Eigen::VectorXd residual = (data.values - base)(known);
    const Eigen::MatrixXd noise = data.noise.covariance();
    double best = -std::numeric_limits<double>::infinity();
    Eigen::VectorXd prediction = base;
    const auto consider = [&](const Eigen::MatrixXd& smooth) {
        const Eigen::LLT<Eigen::MatrixXd> factor((noise + smooth)(known, known));
        const double density = log_normal_density(residual, factor);
        if (density > best) {
            best = density;
            prediction = base + smooth(Eigen::all, known) * factor.solve(residual);
        }
    };
    for (const double length : smooth_lengths) {
        for (const std::vector<SmoothDeparture>& group : smooth_departures(data.observations)) {
            for (const SmoothDeparture& departure : group) {
                const Eigen::MatrixXd unit = covariance(departure, data.observations, base, length);
                for (const double amplitude : smooth_amplitudes) {
                    consider(amplitude * amplitude * unit);
                }
            }
        }
    }
    return prediction;
}

}  // namespace coagula::diagnose
