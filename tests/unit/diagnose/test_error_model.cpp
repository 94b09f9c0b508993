// SPDX-License-Identifier: GPL-3.0-or-later
#include "noise/error_model.hpp"

#include <gtest/gtest.h>
#include <boost/math/distributions/normal.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace coagula::diagnose {
namespace {

/// Two samples with two tables each whose rows follow each other with a correlation of 0.4.
DataSet correlated() {
    constexpr Index rows = 40;
    DataSet data;
    data.values.resize(rows);
    data.noise.deviation.resize(rows);
    data.noise.correlation = Eigen::VectorXd::Zero(rows);
    data.sample_names = {"A", "B"};
    data.effect = 0.05;
    for (Index row = 0; row < rows; ++row) {
        data.values[row] = 100 + 3 * std::sin(7.0 * static_cast<double>(row)) + (row < 20 ? 4 : -2);
        data.noise.deviation[row] = 2 + 0.1 * static_cast<double>(row % 7);
        data.noise.previous.push_back(row % 10 == 0 ? -1 : row - 1);
        data.noise.correlation[row] = row % 10 == 0 ? 0 : 0.4;
        data.sample.push_back(row / 20);
    }
    return data;
}

Eigen::VectorXd prediction() {
    return Eigen::VectorXd::LinSpaced(40, 90, 110);
}

/// Two errors that a prediction has, at one standard error.
Eigen::MatrixXd model_errors() {
    Eigen::MatrixXd errors(40, 2);
    errors << Eigen::VectorXd::LinSpaced(40, 0, 5), Eigen::VectorXd::LinSpaced(40, -1, 1).array().square().matrix() * 3;
    return errors;
}

Prediction with_errors(double degrees = std::numeric_limits<double>::infinity()) {
    return {prediction(), prediction(), {model_errors(), degrees}};
}

/// Without errors that are turned.
Eigen::MatrixXd covariance_of(const RowNoise& noise) {
    Eigen::MatrixXd matrix = noise.deviation.cwiseAbs2().asDiagonal();
    for (Index row = 1; row < noise.deviation.size(); ++row) {
        double product = 1;
        for (Index other = row; noise.previous[static_cast<std::size_t>(other)] >= 0;) {
            product *= noise.correlation[other];
            other = noise.previous[static_cast<std::size_t>(other)];
            matrix(row, other) = matrix(other, row) = product * noise.deviation[row] * noise.deviation[other];
        }
    }
    return matrix;
}

/// By the covariance in full.
double direct(const DataSet& data, double effect, const Eigen::MatrixXd& errors = Eigen::MatrixXd::Zero(40, 1)) {
    Eigen::MatrixXd covariance = covariance_of(data.noise) + errors * errors.transpose();
    for (Index sample = 0; sample < 2; ++sample) {
        Eigen::VectorXd level = prediction();
        for (Index row = 0; row < level.size(); ++row) {
            level[row] *= data.sample[static_cast<std::size_t>(row)] == sample ? 1 : 0;
        }
        covariance += effect * effect * level * level.transpose();
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::VectorXd white = factor.matrixL().solve(data.values - prediction());
    return -0.5 * white.squaredNorm() - factor.matrixLLT().diagonal().array().log().sum();
}

TEST(ErrorModel, AgreesWithTheCovarianceInFull) {
    const DataSet data = correlated();
    EXPECT_NEAR(ErrorModel(data).log_density(prediction()), direct(data, data.effect), 1e-9);
}

TEST(ErrorModel, TakesErrorsOfTheModelAsCovariance) {
    DataSet data = correlated();
    const double exact = direct(data, data.effect, model_errors());
    EXPECT_NEAR(ErrorModel(data).log_density(with_errors()), exact, 1e-9);
    EXPECT_GT(std::abs(exact - direct(data, data.effect)), 0.1) << "the errors make no difference here";
    data.effect = 0;
    EXPECT_NEAR(ErrorModel(data).log_density(with_errors()), direct(data, 0, model_errors()), 1e-9);
}

/// The most probable errors minimise what they and the residuals cost together.
TEST(ErrorModel, FindsErrorsOfTheModel) {
    const DataSet data = correlated();
    Eigen::VectorXd true_errors(2);
    true_errors << 1.5, -0.7;
    DataSet moved = data;
    moved.values = prediction() + model_errors() * true_errors;
    moved.noise.deviation *= 1e-3;
    const Eigen::VectorXd found = ErrorModel(moved).effects(with_errors());
    ASSERT_EQ(found.size(), 4);
    EXPECT_LT(found.head(2).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((found.tail(2) - true_errors).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT(ErrorModel(moved).residual(with_errors()).cwiseAbs().maxCoeff(), 1);
}

/// Logarithm of the mean density over the scale of a deviation that is known from some degrees of freedom.
double averaged(double degrees, const std::function<double(double)>& log_density) {
    double sum = 0;
    constexpr int nodes = 200;  // middles of equal parts of the scaled inverse chi-square distribution
    for (int k = 0; k < nodes; ++k) {
        const double normal = boost::math::quantile(boost::math::normal(), (k + 0.5) / nodes);
        sum += std::exp(log_density(1 / std::sqrt(scaled_chi_square(degrees, normal))) + 100);
    }
    return std::log(sum / nodes) - 100;
}

/// By conditioning the effects of samples and the errors on the data in full.
TEST(ErrorModel, SaysHowWellEffectsAndErrorsAreKnown) {
    const DataSet data = correlated();
    Eigen::MatrixXd parts = Eigen::MatrixXd::Zero(40, 4);
    parts.block(0, 0, 20, 1) = 0.05 * prediction().head(20);
    parts.block(20, 1, 20, 1) = 0.05 * prediction().tail(20);
    parts.rightCols(2) = model_errors();
    const Eigen::MatrixXd all = covariance_of(data.noise) + parts * parts.transpose();
    Eigen::MatrixXd known = Eigen::MatrixXd::Identity(4, 4) - parts.transpose() * all.llt().solve(parts);
    known.topRows(2) *= 0.05;
    known.leftCols(2) *= 0.05;
    const Eigen::MatrixXd found = ErrorModel(data).effect_covariance(with_errors());
    EXPECT_LT((found - known).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GT(known.bottomRightCorner(2, 2).diagonal().minCoeff(), 1e-3);
}

TEST(ErrorModel, AveragesOverAnUncertainScaleOfTheModelsErrors) {
    DataSet data = correlated();
    const double exact =
        averaged(3, [&](double scale) { return direct(data, data.effect, Eigen::MatrixXd(scale * model_errors())); });
    EXPECT_NEAR(ErrorModel(data).log_density(with_errors(3)), exact, 0.1);
    EXPECT_GT(std::abs(direct(data, data.effect, model_errors()) - exact), 0.1) << "the uncertainty makes no difference here";
    data.effect_degrees = 4;
    const double both = averaged(4, [&](double effect) {
        return averaged(3,
                        [&](double scale) { return direct(data, effect * data.effect, Eigen::MatrixXd(scale * model_errors())); });
    });
    // Seven pairs stand for all: enough for evidences that count in e-folds.
    EXPECT_NEAR(ErrorModel(data).log_density(with_errors(3)), both, 0.5);
}

TEST(ErrorModel, AveragesOverAnUncertainSampleEffect) {
    DataSet data = correlated();
    data.effect_degrees = 4;
    const double exact = averaged(4, [&](double scale) { return direct(data, data.effect * scale); });
    EXPECT_NEAR(ErrorModel(data).log_density(prediction()), exact, 0.1);
    EXPECT_GT(std::abs(direct(data, data.effect) - exact), 0.1) << "the uncertainty makes no difference here";
}

TEST(ErrorModel, HasTheDensitiesBesideAPrediction) {
    DataSet data = correlated();
    data.effect_degrees = 3;
    const ErrorModel model(data);
    const Prediction here = with_errors(5);
    const Prediction change(Eigen::VectorXd::LinSpaced(40, 0.3, -0.2), Eigen::VectorXd::LinSpaced(40, -0.1, 0.4), {});
    for (const Accuracy accuracy : {Accuracy::whole, Accuracy::middle}) {
        const std::array<double, 3> densities = model.log_densities(here, change, accuracy);
        for (std::size_t k = 0; k < densities.size(); ++k) {
            Prediction moved = here;
            const double offset = static_cast<double>(k) - 1;
            moved.values += offset * change.values;
            moved.level_slope += offset * change.level_slope;
            EXPECT_NEAR(densities.at(k), model.log_density(moved, {}, accuracy), 1e-9);
        }
    }
}

TEST(ErrorModel, HasTheDensitiesBesideDeparturesOfSeveralSizes) {
    DataSet data = correlated();
    data.effect_degrees = 3;
    const ErrorModel model(data);
    Eigen::MatrixXd further(40, 3);
    further << model.whiten(Eigen::VectorXd::Ones(40)), model_errors();
    const std::vector<double> deviations{0.5, 2, 10};
    const std::vector<double> densities = model.log_densities(with_errors(5), further, 2, deviations);
    ASSERT_EQ(densities.size(), deviations.size());
    for (std::size_t k = 0; k < deviations.size(); ++k) {
        Eigen::MatrixXd scaled = further;
        scaled.rightCols(2) *= deviations[k];
        EXPECT_NEAR(densities[k], model.log_density(with_errors(5), scaled), 1e-9);
    }
}

/// A prediction may be absurd: the density falls with its square and never exceeds that of one that meets every number.
TEST(ErrorModel, DoesNotCancelWhereAPredictionIsAbsurd) {
    const DataSet data = correlated();
    const ErrorModel model(data);
    const Eigen::VectorXd unlike = Eigen::VectorXd::LinSpaced(40, 1, -3).array().cube();
    double before = model.saturated();
    for (const double size : {1e3, 1e6, 1e9, 1e12, 1e15}) {
        const Prediction absurd(size * unlike, size * unlike, {size * model_errors(), 3});
        const double density = model.log_density(absurd);
        EXPECT_LE(density, before) << size;
        // The effects of the samples take up what they can of data that such a prediction does not meet; its own level stays.
        const Prediction alone(size * unlike, Eigen::VectorXd::Zero(40), {});
        EXPECT_NEAR(model.log_density(alone) / (-0.5 * model.whiten(size * unlike).squaredNorm()), 1, 100 / size);
        before = density + 30;
    }
}

/// The tool's own share of the numbers does not scale with the sample.
TEST(ErrorModel, LetsASampleScaleTheMaterialAlone) {
    DataSet data = correlated();
    const Eigen::VectorXd tool = Eigen::VectorXd::LinSpaced(40, 0, -250);  // through zero, as an inertia does
    data.values = prediction() + tool;
    data.values.head(20) += 0.08 * prediction().head(20);
    data.effect = 0.1;
    data.noise.deviation.setConstant(0.2);
    const Prediction seen(prediction() + tool, prediction(), {});
    EXPECT_NEAR(ErrorModel(data).effects(seen)[0], 0.08, 2e-3);
    EXPECT_LT(ErrorModel(data).residual(seen).cwiseAbs().maxCoeff(), 1);
}

/// Deviations that are known from some degrees of freedom: Student's t of the residuals.
TEST(ErrorModel, AveragesOverUncertainDeviations) {
    DataSet data = correlated();
    data.effect = 0;
    data.observations.resize(40);
    for (Observation& one : data.observations) {
        one.errors.degrees = 25;
    }
    for (const double offset : {0.0, 10.0}) {
        const Eigen::VectorXd moved = prediction().array() + offset;
        const double square = data.noise.whiten(data.values - moved).squaredNorm();
        const double exact = std::lgamma(0.5 * (25 + 40)) - std::lgamma(0.5 * 25) - 20 * std::log(0.5 * 25) -
                             0.5 * (25 + 40) * std::log1p(square / 25) - 0.5 * data.noise.log_determinant();
        EXPECT_NEAR(ErrorModel(data).log_density(moved), exact, 0.02) << offset;
    }
}

/// What is left of a covariance once it has been whitened on both sides.
Eigen::MatrixXd whitened(const RowNoise& noise, const Eigen::MatrixXd& covariance) {
    return noise.whitened(noise.whitened(covariance).transpose());
}

TEST(RowNoise, WhitensToUnitCovariance) {
    const DataSet data = correlated();
    EXPECT_LT((whitened(data.noise, covariance_of(data.noise)) - Eigen::MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-12);
}

/// Eight rows whose phase goes through 45 degrees, with errors of torque and phase.
struct Turning {
    static constexpr Index rows = 8;
    static constexpr double torque = 0.03;
    static constexpr double phase = 0.004;
    static constexpr double correlation = 0.5;

    static double angle(Index row) { return 0.4 + 0.1 * static_cast<double>(row); }

    static Experiment experiment() {
        Experiment all;
        Measurement table;
        table.label = table.sample = "A";
        table.columns = {{"angular_frequency", "rad/s", {}}, {"storage_modulus", "Pa", {}}, {"loss_modulus", "Pa", {}}};
        for (Index row = 0; row < rows; ++row) {
            table.columns[0].values.push_back(1.0 + static_cast<double>(row));
            table.columns[1].values.push_back(1000 * std::cos(angle(row)));
            table.columns[2].values.push_back(1000 * std::sin(angle(row)));
        }
        all.measurements.push_back(table);
        return all;
    }

    static DataSet data() {
        const ErrorLaw law{.correlation = correlation};
        ErrorSpec errors;
        errors.tables = {{.polar = true,
                          .columns = {{"storage_modulus", std::vector<double>(rows, 1000 * torque), law},
                                      {"loss_modulus", std::vector<double>(rows, 1000 * phase), law}}}};
        return data_set_of(experiment(), errors);
    }

    /// From errors along and across G*, each correlated from row to row; all G', then all G''.
    static Eigen::MatrixXd covariance() {
        Eigen::MatrixXd moduli = Eigen::MatrixXd::Zero(2 * rows, 2 * rows);  // of errors along, then across
        for (Index row = 0; row < rows; ++row) {
            moduli(row, row) = 1000 * torque * std::cos(angle(row));
            moduli(rows + row, row) = 1000 * torque * std::sin(angle(row));
            moduli(row, rows + row) = -1000 * phase * std::sin(angle(row));
            moduli(rows + row, rows + row) = 1000 * phase * std::cos(angle(row));
        }
        Eigen::MatrixXd errors = Eigen::MatrixXd::Zero(2 * rows, 2 * rows);
        for (Index row = 0; row < rows; ++row) {
            for (Index other = 0; other < rows; ++other) {
                const double both = std::pow(correlation, std::abs(static_cast<double>(row - other)));
                errors(row, other) = errors(rows + row, rows + other) = both;
            }
        }
        return moduli * errors * moduli.transpose();
    }
};

TEST(RowNoise, WhitensErrorsOfTorqueAndPhase) {
    const DataSet data = Turning::data();
    const Eigen::MatrixXd covariance = Turning::covariance();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(2 * Turning::rows, 2 * Turning::rows);
    const Eigen::MatrixXd left = whitened(data.noise, covariance) - unit;
    EXPECT_LT((data.noise.marginal_deviation() - covariance.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(data.noise.log_determinant(), std::log(covariance.determinant()), 1e-9);
}

/// Its own errors, which are turned, and the effect of the sample on all moduli together.
TEST(ErrorModel, SaysHowDataScatterAboutAPrediction) {
    DataSet data = Turning::data();
    data.effect = 0.2;
    const Eigen::VectorXd level = Eigen::VectorXd::LinSpaced(2 * Turning::rows, 900, 1100);
    const Eigen::MatrixXd exact = Turning::covariance() + 0.04 * level * level.transpose();
    EXPECT_LT((ErrorModel(data).covariance(level) - exact).cwiseAbs().maxCoeff(), 1e-6);
}

/// Colouring undoes whitening.
TEST(RowNoise, ColoursWhatItWhitens) {
    const Eigen::VectorXd white = Eigen::VectorXd::LinSpaced(40, -1, 2).array().sin();
    for (const DataSet& data : {correlated(), Turning::data()}) {
        const Eigen::VectorXd own = white.head(data.size());
        EXPECT_LT((data.noise.whiten(data.noise.coloured(own)) - own).cwiseAbs().maxCoeff(), 1e-12);
    }
}

TEST(RowNoise, OfOneModulusAloneIsItsOwn) {
    const DataSet data = Turning::data();
    std::vector<Index> storage(Turning::rows);
    std::iota(storage.begin(), storage.end(), 0);
    const DataSet part = data.part(storage);
    const Eigen::VectorXd exact = Turning::covariance().diagonal().head(Turning::rows).cwiseSqrt();
    EXPECT_LT((part.noise.deviation - exact).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace coagula::diagnose
