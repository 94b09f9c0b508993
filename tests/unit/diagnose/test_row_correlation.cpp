// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/row_correlation.hpp"

#include <coagula/common/random.hpp>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace coagula::diagnose {
namespace {

constexpr double known_correlation = 0.45;  // of correlations from 0 to 0.9 that are equally probable
constexpr double known_error = 0.26;

/// Tables of moduli whose rows have errors of 2; row 3 of the first is missing.
DataSet tables_of(Index rows, Index tables) {
    DataSet data;
    for (Index k = 0; k < rows * tables; ++k) {
        Observation one;
        one.measurement = static_cast<std::size_t>(k / rows);
        one.row = static_cast<std::size_t>(k % rows) + (k < rows && k > 2 ? 1U : 0U);
        one.errors.correlation = known_correlation;
        one.errors.correlation_error = known_error;
        data.observations.push_back(one);
        data.noise.previous.push_back(k % rows == 0 ? -1 : k - 1);
    }
    data.values = Eigen::VectorXd::Zero(rows * tables);
    data.noise.deviation = Eigen::VectorXd::Constant(rows * tables, 2);
    data.noise.correlation = Eigen::VectorXd::Constant(rows * tables, known_correlation);
    for (Index table = 0; table < tables; ++table) {
        data.noise.correlation[table * rows] = 0;
    }
    data.noise.correlation[3] = known_correlation * known_correlation;
    return data;
}

/// Errors of neighbours with this correlation.
Eigen::VectorXd drawn(const DataSet& data, double correlation, std::uint64_t seed) {
    Eigen::VectorXd errors(data.size());
    for (Index k = 0; k < data.size(); ++k) {
        const double normal = random_normal(seed, RandomPurpose::test, static_cast<std::uint64_t>(k), 0).x();
        const Index before = data.noise.previous[static_cast<std::size_t>(k)];
        const double with_last = before < 0 ? 0 : std::pow(correlation, k == 3 ? 2 : 1);
        errors[k] = with_last * (before < 0 ? 0 : errors[before]) + std::sqrt(1 - with_last * with_last) * normal;
    }
    return 2 * errors;
}

/// Its mean by the covariance in full, over contrasts that no cubic moves.
/// @param share of the departures that errors make.
double direct_mean(const DataSet& data, const Eigen::VectorXd& departures, Index rows, double share) {
    Eigen::VectorXd logarithms(300);
    for (Index node = 0; node < logarithms.size(); ++node) {
        const double correlation = 0.9 * (static_cast<double>(node) + 0.5) / static_cast<double>(logarithms.size());
        double determinants = 0;
        double squares = 0;
        for (Index first = 0; first < data.size(); first += rows) {
            Eigen::MatrixXd cubic(rows, 4);
            Eigen::MatrixXd covariance(rows, rows);
            for (Index i = 0; i < rows; ++i) {
                const auto place = static_cast<double>(i);
                cubic.row(i) << 1, place, place * place, place * place * place;
                for (Index j = 0; j < rows; ++j) {
                    const auto row = [&](Index k) {
                        return static_cast<double>(data.observations[static_cast<std::size_t>(first + k)].row);
                    };
                    covariance(i, j) = std::pow(correlation, std::abs(row(i) - row(j)));
                }
            }
            const Eigen::MatrixXd contrasts = Eigen::FullPivLU<Eigen::MatrixXd>(cubic.transpose()).kernel().transpose();
            const Eigen::LLT<Eigen::MatrixXd> factor(contrasts * covariance * contrasts.transpose());
            determinants += factor.matrixLLT().diagonal().array().log().sum();
            squares += factor.matrixL().solve(contrasts * departures.segment(first, rows)).squaredNorm();
        }
        const Index polynomials = data.size() / rows;
        const auto degrees = static_cast<double>(data.size() - 4 * polynomials);
        logarithms[node] = share * (-determinants - 0.5 * degrees * std::log(squares)) -
                           0.5 * std::pow((correlation - known_correlation) / known_error, 2);
    }
    const Eigen::ArrayXd weights = (logarithms.array() - logarithms.maxCoeff()).exp();
    const Eigen::ArrayXd places = Eigen::ArrayXd::LinSpaced(logarithms.size(), 0.0015, 0.8985);
    return (weights * places).sum() / weights.sum();
}

TEST(RowCorrelation, AgreesWithTheCovarianceInFull) {
    const DataSet data = tables_of(14, 3);
    const Eigen::VectorXd errors = drawn(data, 0.6, 1);
    EXPECT_NEAR(correlations_shown(data, 0.7 * errors)[0].mean, direct_mean(data, errors, 14, 1), 2e-3);
}

TEST(RowCorrelation, DepartsLittleFromWhatWasKnownWhereTheModelFails) {
    const DataSet data = tables_of(14, 3);
    const Eigen::VectorXd errors = drawn(data, 0, 1);
    const double once = correlations_shown(data, errors)[0].mean;
    const double failing = correlations_shown(data, 10 * errors)[0].mean;
    EXPECT_LT(once, 0.3);
    EXPECT_NEAR(failing, known_correlation, 0.02);
}

TEST(RowCorrelation, LongTablesTellItAndACubicDoesNotCount) {
    const DataSet data = tables_of(100, 4);
    for (const double correlation : {0.0, 0.3, 0.6, 0.8}) {
        const Eigen::VectorXd errors = drawn(data, correlation, 2);
        const RowCorrelation shown = correlations_shown(data, errors)[0];
        EXPECT_NEAR(shown.mean, correlation, 0.12) << correlation;  // 2.5 standard errors
        EXPECT_LT(shown.deviation, 0.06);
        Eigen::VectorXd smooth(data.size());
        for (Index k = 0; k < data.size(); ++k) {
            const double place = static_cast<double>(k % 100) / 50 - 1;
            smooth[k] = 40 * place * place * place - 13 * place + 7;
        }
        EXPECT_NEAR(correlations_shown(data, errors + smooth)[0].mean, shown.mean, 1e-9) << correlation;
    }
}

TEST(RowCorrelation, ShortTablesSayNothing) {
    const DataSet data = tables_of(7, 3);
    const RowCorrelations shown = correlations_shown(data, drawn(data, 0.6, 3));
    EXPECT_EQ(shown[0].mean, known_correlation);
    EXPECT_EQ(shown[0].deviation, known_error);
    EXPECT_EQ(shown[1].mean, 0);  // there are no phases
}

TEST(RowCorrelation, TakesThePlaceOfWhatWasKnown) {
    DataSet data = tables_of(10, 1);
    data.observations[9].errors.correlation = 0.2;  // stated
    data.observations[9].errors.correlation_error = 0;
    data.noise.correlation[9] = 0.2;
    data.noise.correlation[5] *= -1;  // its axis is turned
    set_correlations({{{0.6, 0.1}, {}}}, data);
    EXPECT_NEAR(data.noise.correlation[1], 0.6, 1e-12);
    EXPECT_NEAR(data.noise.correlation[3], 0.36, 1e-12);  // two rows on
    EXPECT_NEAR(data.noise.correlation[5], -0.6, 1e-12);
    EXPECT_EQ(data.noise.correlation[9], 0.2);
    EXPECT_EQ(data.noise.correlation[0], 0);
    EXPECT_EQ(data.observations[1].errors.correlation, 0.6);
    EXPECT_EQ(data.observations[1].errors.correlation_error, 0.1);
}

}  // namespace
}  // namespace coagula::diagnose
