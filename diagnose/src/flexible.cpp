#include "flexible.hpp"

#include "detection.hpp"
#include "weights.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr std::array amplitudes{0.03, 0.1, 0.3, 1.0};
constexpr std::array lengths{0.15, 0.4, 1.0};

/// Ranks 0 .. 1 of a coordinate; 0 where it is unknown or does not vary.
Eigen::VectorXd ranks(const std::vector<Observation>& observations, Coordinate coordinate) {
    std::vector<double> values;
    for (const Observation& observation : observations) {
        values.push_back(coordinate_of(observation, coordinate));
    }
    std::vector<double> sorted;
    std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double value) { return std::isfinite(value); });
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end(), [](double a, double b) { return b <= a * 1.001; }), sorted.end());
    Eigen::VectorXd rank = Eigen::VectorXd::Zero(static_cast<Index>(values.size()));
    for (std::size_t k = 0; k < values.size() && sorted.size() > 1; ++k) {
        const auto place = std::lower_bound(sorted.begin(), sorted.end(), values[k] * 0.9995) - sorted.begin();
        rank[static_cast<Index>(k)] =
            std::isfinite(values[k]) ? static_cast<double>(place) / static_cast<double>(sorted.size() - 1) : 0.0;
    }
    return rank;
}

/// Size of |G*| at each observation: what a correction of G'' is relative to.
Eigen::VectorXd levels(const std::vector<Observation>& observations) {
    Eigen::VectorXd level(static_cast<Index>(observations.size()));
    for (std::size_t k = 0; k < observations.size(); ++k) {
        double squared = 0;
        for (const Observation& other : observations) {
            if (other.measurement == observations[k].measurement && other.row == observations[k].row) {
                squared += other.value * other.value;
            }
        }
        level[static_cast<Index>(k)] = std::sqrt(squared);
    }
    return level;
}

double log_normal_density(const Eigen::VectorXd& residual, const Eigen::LLT<Eigen::MatrixXd>& factor) {
    const Eigen::VectorXd white = factor.matrixL().solve(residual);
    return -0.5 * white.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

Eigen::MatrixXd smooth_covariance(const std::vector<Observation>& observations, double amplitude, double length) {
    const Eigen::VectorXd level = levels(observations);
    std::vector<Eigen::VectorXd> coordinates;
    for (const Coordinate coordinate : all_coordinates()) {
        coordinates.push_back(ranks(observations, coordinate));
    }
    const Index count = level.size();
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
    for (Index i = 0; i < count; ++i) {
        for (Index j = 0; j < count; ++j) {
            if (observations[static_cast<std::size_t>(i)].loss == observations[static_cast<std::size_t>(j)].loss) {
                double squared = 0;
                for (const Eigen::VectorXd& rank : coordinates) {
                    squared += (rank[i] - rank[j]) * (rank[i] - rank[j]);
                }
                covariance(i, j) = amplitude * amplitude * level[i] * level[j] * std::exp(-0.5 * squared / (length * length));
            }
        }
    }
    return covariance;
}

double flexible_evidence(const DataSet& data, const Forward& forward, const Eigen::VectorXd& base) {
    // In proportion to the base model and not to the data: data that grow by orders of magnitude would be one constant over the
    // measured levels, whatever the reason.
    std::vector<Observation> expected = data.observations;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        expected[k].value = base[static_cast<Index>(k)];
    }
    std::vector<double> evidence;
    for (const double amplitude : amplitudes) {
        for (const double length : lengths) {
            const Likelihood likelihood(data, smooth_covariance(expected, amplitude, length));
            const Inference inference(forward, likelihood);
            evidence.push_back(inference.fit({}).log_evidence);
        }
    }
    return log_sum(evidence) - std::log(static_cast<double>(evidence.size()));
}

Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known) {
    const Eigen::VectorXd residual = (data.values - base)(known);
    const Eigen::MatrixXd noise = data.noise.covariance();
    double best = -1e300;
    Eigen::VectorXd prediction = base;
    for (const double amplitude : amplitudes) {
        for (const double length : lengths) {
            const Eigen::MatrixXd smooth = smooth_covariance(data.observations, amplitude, length);
            const Eigen::LLT<Eigen::MatrixXd> factor((noise + smooth)(known, known));
            const double density = log_normal_density(residual, factor);
            if (density > best) {
                best = density;
                prediction = base + smooth(Eigen::all, known) * factor.solve(residual);
            }
        }
    }
    return prediction;
}

}  // namespace coagula::diagnose
