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

constexpr std::array amplitudes{0.03, 0.15, 0.75};
constexpr std::array lengths{0.2, 0.7};

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

double log_normal_density(const Eigen::VectorXd& residual, const Eigen::LLT<Eigen::MatrixXd>& factor) {
    const Eigen::VectorXd white = factor.matrixL().solve(residual);
    return -0.5 * white.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
}

/// Correlation by the distance in these ranks.
Eigen::MatrixXd correlation(const std::vector<Eigen::VectorXd>& ranks, double length) {
    const Index count = ranks.front().size();
    Eigen::ArrayXXd squared = Eigen::ArrayXXd::Zero(count, count);
    for (const Eigen::VectorXd& rank : ranks) {
        squared += (rank.replicate(1, count) - rank.transpose().replicate(count, 1)).array().square();
    }
    return (-0.5 / (length * length) * squared).exp();
}

/// What a correction is of.
enum class Corrected { storage, loss, both };

bool takes_part(const Observation& one, Corrected corrected) {
    return corrected == Corrected::both || one.loss == (corrected == Corrected::loss);
}

/// Products of the levels of two observations of one observable, where that is corrected.
Eigen::MatrixXd products(const std::vector<Observation>& observations, Corrected corrected) {
    Eigen::VectorXd values(static_cast<Index>(observations.size()));
    for (std::size_t k = 0; k < observations.size(); ++k) {
        values[static_cast<Index>(k)] = observations[k].value;
    }
    const Eigen::VectorXd level = complex_moduli(observations, values);
    Eigen::MatrixXd product = level * level.transpose();
    for (Index i = 0; i < product.rows(); ++i) {
        for (Index j = 0; j < product.cols(); ++j) {
            const Observation& one = observations[static_cast<std::size_t>(i)];
            const Observation& other = observations[static_cast<std::size_t>(j)];
            const bool alike =
                one.loss == other.loss && one.third_harmonic == other.third_harmonic && !one.difference && !other.difference;
            product(i, j) *= alike && takes_part(one, corrected) ? 1.0 : 0.0;
        }
    }
    return product;
}

/// A smooth correction: of which moduli, and along which coordinates, as the sum of a part along each or along all together.
struct Correction {
    Corrected corrected;
    std::vector<Eigen::VectorXd> along;  ///< ranks; none: a constant
    bool together = false;
};

/// In groups that are equally probable: along one coordinate, the sum of two of these, and along all coordinates together; each of
/// one observable or of both.
std::vector<std::vector<Correction>> smooth_corrections(const std::vector<Observation>& observations) {
    std::vector<Eigen::VectorXd> varying;
    for (const Coordinate coordinate : all_coordinates()) {
        const Eigen::VectorXd rank = ranks(observations, coordinate);
        if (rank.maxCoeff() > 0) {
            varying.push_back(rank);
        }
    }
    std::vector<std::vector<Correction>> groups;
    for (const Corrected corrected : {Corrected::storage, Corrected::loss, Corrected::both}) {
        const bool any = std::any_of(observations.begin(), observations.end(),
                                     [&](const Observation& one) { return takes_part(one, corrected); });
        if (!any) {
            continue;
        }
        std::vector<Correction> one;
        std::vector<Correction> two;
        for (std::size_t k = 0; k < varying.size(); ++k) {
            one.push_back({corrected, {varying[k]}});
            for (std::size_t other = 0; other < k; ++other) {
                two.push_back({corrected, {varying[k], varying[other]}});
            }
        }
        groups.push_back(one.empty() ? std::vector<Correction>{{corrected, {}}} : one);
        if (!two.empty()) {
            groups.push_back(two);
            groups.push_back({{corrected, varying, true}});
        }
    }
    return groups;
}

/// Covariance of a correction of unit size.
Eigen::MatrixXd covariance(const Correction& correction, const std::vector<Observation>& observations, double length) {
    const Eigen::MatrixXd product = products(observations, correction.corrected);
    if (correction.along.empty()) {
        return product;
    }
    if (correction.together) {
        return product.cwiseProduct(correlation(correction.along, length));
    }
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(product.rows(), product.cols());
    for (const Eigen::VectorXd& rank : correction.along) {
        sum += correlation({rank}, length);
    }
    return product.cwiseProduct(sum) / static_cast<double>(correction.along.size());
}

double log_mean(const std::vector<double>& logarithms) {
    return log_sum(logarithms) - std::log(static_cast<double>(logarithms.size()));
}

}  // namespace

double flexible_evidence(const DataSet& data, const Forward& forward, const Eigen::VectorXd& base) {
    // In proportion to the base model and not to the data: data that grow by orders of magnitude would be one constant over the
    // measured levels, whatever the reason.
    std::vector<Observation> expected = data.observations;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        expected[k].value = base[static_cast<Index>(k)];
    }
    const std::vector<std::vector<Correction>> groups = smooth_corrections(expected);
    std::vector<double> evidence;
    for (const double length : lengths) {
        for (const std::vector<Correction>& group : groups) {
            std::vector<double> members;
            for (const Correction& correction : group) {
                const Eigen::MatrixXd unit = covariance(correction, expected, length);
                for (const double amplitude : amplitudes) {
                    const Likelihood likelihood(data, amplitude * amplitude * unit);
                    members.push_back(Inference(forward, likelihood).fit({}).log_evidence);
                }
            }
            evidence.push_back(log_mean(members));
        }
    }
    return log_mean(evidence);
}

Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known) {
    const Eigen::VectorXd residual = (data.values - base)(known);
    const Eigen::MatrixXd noise = data.noise.covariance();
    double best = -1e300;
    Eigen::VectorXd prediction = base;
    const auto consider = [&](const Eigen::MatrixXd& smooth) {
        const Eigen::LLT<Eigen::MatrixXd> factor((noise + smooth)(known, known));
        const double density = log_normal_density(residual, factor);
        if (density > best) {
            best = density;
            prediction = base + smooth(Eigen::all, known) * factor.solve(residual);
        }
    };
    const std::vector<std::vector<Correction>> groups = smooth_corrections(data.observations);
    for (const double length : lengths) {
        for (const std::vector<Correction>& group : groups) {
            for (const Correction& correction : group) {
                const Eigen::MatrixXd unit = covariance(correction, data.observations, length);
                for (const double amplitude : amplitudes) {
                    consider(amplitude * amplitude * unit);
                }
            }
        }
    }
    return prediction;
}

}  // namespace coagula::diagnose
