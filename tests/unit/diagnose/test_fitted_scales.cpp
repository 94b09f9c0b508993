// SPDX-License-Identifier: GPL-3.0-or-later
// Departures over scales that they tell themselves, and what is detected where few replicates tell the noise.
#include "infer/detection.hpp"
#include "infer/fitted_scales.hpp"

#include "hidden_effects.hpp"

#include <coagula/common/dense.hpp>
#include <coagula/diagnose/noise.hpp>

#include <gtest/gtest.h>

#include <numeric>

namespace coagula::diagnose {
namespace {

constexpr Index numbers = 24;

std::vector<Index> rows_between(Index from, Index to) {
    std::vector<Index> rows(static_cast<std::size_t>(to - from));
    std::iota(rows.begin(), rows.end(), from);
    return rows;
}

Eigen::MatrixXd random_columns(Index rows, Index columns, std::uint64_t seed) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Index row, Index column) {
        return drawn_normal(seed, static_cast<std::uint64_t>(row * columns + column));
    });
}

/// The posterior of one variance is scaled inverse chi-square: its mode is in closed form, whatever was fitted.
TEST(FittedScales, OneScaleIsInClosedForm) {
    for (const Index fitted : {0, 1, 5}) {
        const Eigen::MatrixXd basis = dense::orthonormal(random_columns(numbers, fitted, 1));
        Eigen::MatrixXd columns = random_columns(numbers, 3, 2);
        columns.col(1) *= 30;
        columns -= (basis * (basis.transpose() * columns)).eval();
        for (const double degrees : {1.5, 6.0, 40.0}) {
            const Eigen::MatrixXd over = over_fitted_scales(columns, basis, {{degrees, rows_between(0, numbers)}});
            for (Index column = 0; column < columns.cols(); ++column) {
                const double variance =
                    (degrees + columns.col(column).squaredNorm()) / (degrees + static_cast<double>(numbers - fitted));
                EXPECT_LT((over.col(column) * std::sqrt(variance) - columns.col(column)).cwiseAbs().maxCoeff(),
                          0.03 * columns.col(column).cwiseAbs().maxCoeff())
                    << fitted << " fitted, " << degrees << " degrees";
            }
        }
    }
}

TEST(FittedScales, KnownScalesStay) {
    const Eigen::MatrixXd columns = random_columns(numbers, 2, 3);
    EXPECT_EQ(over_fitted_scales(columns, Eigen::MatrixXd(numbers, 0), {}), columns);
    const Eigen::MatrixXd over = over_fitted_scales(columns, Eigen::MatrixXd(numbers, 0), {{1e9, rows_between(0, 10)}});
    EXPECT_LT((over - columns).cwiseAbs().maxCoeff(), 1e-6);
}

/// A straight line through two groups, one of which is ten times as noisy as stated: it follows the other one, as a fit by the
/// true deviations does.
TEST(FittedScales, WhatIsFittedFollowsTheQuieterGroup) {
    const Eigen::MatrixXd basis = dense::orthonormal(Eigen::MatrixXd::Ones(2 * numbers, 1));
    Eigen::VectorXd data = random_columns(2 * numbers, 1, 4);
    data.tail(numbers) *= 10;
    const Eigen::VectorXd left = data - basis * (basis.transpose() * data);
    const std::vector<ScaledRows> groups{{4, rows_between(0, numbers)}, {4, rows_between(numbers, 2 * numbers)}};
    const Eigen::VectorXd over = over_fitted_scales(left, basis, groups);
    EXPECT_NEAR(over.head(numbers).mean(), 0, 0.15);
    EXPECT_NEAR(over.squaredNorm(), static_cast<double>(2 * numbers), 8);
    EXPECT_LT(over.tail(numbers).norm(), 0.2 * data.tail(numbers).norm());
}

/// |G*| of two samples at seven gaps: equal, or larger at the small ones. Errors of 1 % are told by these fourteen numbers alone.
Experiment gaps_of_two_samples(double more_at_the_smallest, std::uint64_t seed) {
    const std::vector<double> gaps{3e-4, 4e-4, 5.5e-4, 7.5e-4, 1e-3, 1.4e-3, 2e-3};
    Experiment experiment;
    experiment.material.kind = MaterialKind::smooth;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    for (const char* sample : {"A", "B"}) {
        const double level = 1000 * (1 + 0.03 * drawn_normal(++seed, 0));
        Measurement table{.kind = MeasurementKind::gap_series, .label = sample, .sample = sample, .columns = {}, .left_out = {}};
        table.columns = {{"gap", "m", gaps},
                         {"storage_modulus", "Pa", {}},
                         {"loss_modulus", "Pa", {}},
                         {"angular_frequency", "rad/s", std::vector<double>(gaps.size(), 20.0)},
                         {"strain", "1", std::vector<double>(gaps.size(), 1e-3)}};
        for (std::size_t row = 0; row < gaps.size(); ++row) {
            const double size = level * (1 + more_at_the_smallest * std::pow(gaps[0] / gaps[row], 3));
            table.columns[1].values.push_back(size * (1 + 0.01 * drawn_normal(seed, 2 * row + 1)));
            table.columns[2].values.push_back(0.4 * size * (1 + 0.01 * drawn_normal(seed, 2 * row + 2)));
        }
        experiment.measurements.push_back(std::move(table));
    }
    return experiment;
}

double p_value_of(const Experiment& experiment) {
    const StatedNoise stated{.sample = 0.1};
    const DataSet data =
        data_set_of(experiment, estimated_errors(experiment, noise_of_tables(experiment.measurements, stated), stated));
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    return detect(inference, inference.fit({}), {find_mechanism("gap-error"), find_mechanism("wall-slip")}, 1, 399).p_value;
}

/// Few replicates know the errors to a factor of two. A rise by 40 % at the small gaps stands out of what is left all the same.
TEST(Detection, FewReplicatesHideNothingThatEveryoneSees) {
    for (const std::uint64_t seed : {10U, 20U, 30U}) {
        EXPECT_LE(p_value_of(gaps_of_two_samples(0.4, seed)), 0.02) << "seed " << seed;
    }
}

TEST(Detection, FewReplicatesShowNothingWhereNothingIs) {
    int found = 0;
    for (std::uint64_t seed = 100; seed < 500; seed += 10) {
        found += p_value_of(gaps_of_two_samples(0, seed)) <= 0.05 ? 1 : 0;
    }
    EXPECT_LE(found, 5) << "of 40, at a level of 5 %";
}

}  // namespace
}  // namespace coagula::diagnose
