// SPDX-License-Identifier: GPL-3.0-or-later
#include "row_correlation.hpp"

#include <coagula/common/log_probability.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

constexpr Index fewest_rows = 8;
constexpr Index followed = 4;  ///< functions of the number of the row that take no part: a cubic
constexpr double strongest = 0.9;
constexpr int nodes = 90;

/// Errors of one kind in the order of a table's rows, over their deviation; beside them the functions that take no part.
struct Chain {
    Eigen::VectorXd lags;  ///< rows from the one before; the first is not used
    Eigen::MatrixXd columns;
};

/// Logarithm of the restricted likelihood but for the size of the errors.
struct Restricted {
    double logarithm = 0;
    double squares = 0;
    double degrees = 0;
};

Restricted restricted(const Chain& chain, double correlation) {
    Eigen::MatrixXd white = chain.columns;
    Restricted result;
    for (Index row = 1; row < white.rows(); ++row) {
        const double with_last = std::pow(correlation, chain.lags[row]);
        const double left = 1 - with_last * with_last;
        white.row(row) = (chain.columns.row(row) - with_last * chain.columns.row(row - 1)) / std::sqrt(left);
        result.logarithm -= 0.5 * std::log(left);
    }
    const auto functions = white.leftCols(followed);
    const Eigen::LLT<Eigen::MatrixXd> factor(functions.transpose() * functions);
    const Eigen::VectorXd half = factor.matrixL().solve(functions.transpose() * white.col(followed));
    result.logarithm -= factor.matrixLLT().diagonal().array().log().sum();
    result.squares = white.col(followed).squaredNorm() - half.squaredNorm();
    result.degrees = static_cast<double>(white.rows() - followed);
    return result;
}

/// Chains of the errors of torque, or of phase, one for each table that is long enough.
std::vector<Chain> chains_of(const DataSet& data, Eigen::VectorXd departures, bool of_phase) {
    RowNoise independent = data.noise;
    independent.correlation.setZero();
    departures = independent.whiten(departures);
    std::map<std::size_t, std::map<std::size_t, Index>> tables;  // place of each row
    for (Index k = 0; k < data.size(); ++k) {
        const Observation& one = data.observations[static_cast<std::size_t>(k)];
        if (has_error_of_phase(one) == of_phase && !is<Harmonic>(one) && one.errors.correlation_error > 0) {
            tables[one.measurement].emplace(one.row, k);
        }
    }
    std::vector<Chain> chains;
    for (const auto& [number, rows] : tables) {
        const auto size = static_cast<Index>(rows.size());
        if (size < fewest_rows) {
            continue;
        }
        Chain chain{Eigen::VectorXd::Zero(size), Eigen::MatrixXd(size, followed + 1)};
        double sign = 1;
        std::size_t before = rows.begin()->first;
        Index place = 0;
        for (const auto& [row, k] : rows) {
            sign = data.noise.correlation[k] < 0 ? -sign : sign;
            chain.lags[place] = static_cast<double>(row - before);
            const double along = 2 * static_cast<double>(place) / static_cast<double>(size - 1) - 1;
            chain.columns.row(place) << 1, along, 1.5 * along * along - 0.5, along * (2.5 * along * along - 1.5),
                sign * departures[k];
            before = row;
            ++place;
        }
        chains.push_back(std::move(chain));
    }
    return chains;
}

RowCorrelation shown_by(const std::vector<Chain>& chains, RowCorrelation beforehand) {
    std::vector<double> logarithms;
    std::vector<double> places;
    double share = 1;  // of the departures that errors make
    for (int node = 0; node < nodes; ++node) {
        const double place = strongest * (node + 0.5) / nodes;
        Restricted all;
        for (const Chain& chain : chains) {
            const Restricted one = restricted(chain, place);
            all.logarithm += one.logarithm;
            all.squares += one.squares;
            all.degrees += one.degrees;
        }
        share = node == 0 ? std::min(1.0, all.degrees / all.squares) : share;
        const double prior = std::pow((place - beforehand.mean) / beforehand.deviation, 2);
        places.push_back(place);
        logarithms.push_back(share * (all.logarithm - 0.5 * all.degrees * std::log(all.squares)) - 0.5 * prior);
    }
    const std::vector<double> weights = probabilities_of(std::move(logarithms));
    double mean = 0;
    double square = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        mean += weights[k] * places[k];
        square += weights[k] * places[k] * places[k];
    }
    return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

}  // namespace

RowCorrelations correlations_shown(const DataSet& data, const Eigen::VectorXd& departures) {
    RowCorrelations all{};
    for (const bool of_phase : {false, true}) {
        const auto& observations = data.observations;
        const auto uncertain = std::find_if(observations.begin(), observations.end(), [&](const Observation& one) {
            return has_error_of_phase(one) == of_phase && one.errors.correlation_error > 0;
        });
        if (uncertain != observations.end()) {
            const RowCorrelation known{uncertain->errors.correlation, uncertain->errors.correlation_error};
            const std::vector<Chain> chains = chains_of(data, departures, of_phase);
            all[of_phase ? 1 : 0] = chains.empty() ? known : shown_by(chains, known);
        }
    }
    return all;
}

void set_correlations(const RowCorrelations& correlations, DataSet& data) {
    for (Index row = 0; row < data.size(); ++row) {
        Observation& one = data.observations[static_cast<std::size_t>(row)];
        const RowCorrelation& shown = correlations[has_error_of_phase(one) ? 1 : 0];
        if (one.errors.correlation_error == 0) {
            continue;
        }
        double& with_last = data.noise.correlation[row];
        if (with_last != 0) {
            const double lag = std::log(std::abs(with_last)) / std::log(one.errors.correlation);
            with_last = std::copysign(std::pow(shown.mean, lag), with_last);
        }
        one.errors.correlation = shown.mean;
        one.errors.correlation_error = shown.deviation;
    }
}

}  // namespace coagula::diagnose
