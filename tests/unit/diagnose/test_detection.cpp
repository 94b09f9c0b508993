// SPDX-License-Identifier: GPL-3.0-or-later
// Along which rows a departure is looked for.
#include "infer/detection.hpp"
#include "infer/localise.hpp"

#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <set>

namespace coagula::diagnose {
namespace {

constexpr std::size_t frequency_table = 0;
constexpr std::size_t amplitude_table = 1;

Measurement sweep(MeasurementKind kind, const std::vector<double>& strains, const std::vector<double>& angular_frequencies,
                  const std::function<double(double strain)>& storage_modulus, std::uint64_t seed) {
    constexpr double relative_error = 0.02;
    Column storage{"storage_modulus", "Pa", {}};
    for (std::size_t row = 0; row < strains.size(); ++row) {
        const double value = storage_modulus(strains[row]);
        storage.values.push_back(value * (1 + relative_error * drawn_normal(seed, row)));
        storage.standard_errors.push_back(relative_error * value);
    }
    return {.kind = kind,
            .label = "sweep",
            .sample = "A",
            .columns = {{"strain", "1", strains}, {"angular_frequency", "rad/s", angular_frequencies}, storage},
            .left_out = {}};
}

/// G' does not depend on the frequency. It falls with the strain, which the second table alone sweeps, at 10 rad/s.
Experiment both_sweeps() {
    const std::vector<double> few(16, 1e-4);
    const std::vector<double> one(16, 10.0);
    const auto yielding = [](double strain) { return 6e5 / (1 + std::pow(strain / 0.03, 2)); };
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.measurements = {sweep(MeasurementKind::frequency_sweep, few, logarithmic_steps(0.5, 600, 16), yielding, 1),
                               sweep(MeasurementKind::amplitude_sweep, logarithmic_steps(1e-4, 0.1, 16), one, yielding, 2)};
    return experiment;
}

/// What the base model leaves over of an experiment.
class Detected : public ::testing::Test {
protected:
    std::set<std::size_t> tables_along(Coordinate coordinate) const {
        std::set<std::size_t> tables;
        for (const MisfitStatistic& statistic : detection_.statistics) {
            for (const Index row : statistic.coordinate == coordinate ? statistic.rows : std::vector<Index>{}) {
                tables.insert(data_.observations[static_cast<std::size_t>(row)].measurement);
            }
        }
        return tables;
    }

    std::vector<Misfit> misfits_along(Coordinate coordinate) const {
        std::vector<Misfit> misfits = localise(inference_, base_, detection_);
        std::erase_if(misfits, [&](const Misfit& misfit) { return misfit.axis != name_of(coordinate); });
        return misfits;
    }

private:
    Experiment experiment_ = both_sweeps();
    DataSet data_ = data_set_of(experiment_, {});
    Forward forward_{experiment_, data_.observations, simulator()};
    ErrorModel errors_{data_};
    Inference inference_{forward_, errors_};
    Fit base_ = inference_.fit({});
    Detection detection_ = detect(inference_, base_, {}, 1, 199);
};

TEST_F(Detected, AlongACoordinateAreTheTablesThatSweepIt) {
    EXPECT_EQ(tables_along(Coordinate::angular_frequency), std::set{frequency_table});
    EXPECT_EQ(tables_along(Coordinate::strain), std::set{amplitude_table});
}

/// Sorted by frequency, the rows of the amplitude sweep would be a dip at 10 rad/s.
TEST_F(Detected, AFallAlongStrainIsNoneAlongFrequency) {
    ASSERT_FALSE(misfits_along(Coordinate::strain).empty());
    const Misfit fall = misfits_along(Coordinate::strain).front();
    EXPECT_EQ(fall.observable, "storage_modulus");
    EXPECT_FALSE(std::get<SmoothMisfit>(fall.what).is_the_same);
    EXPECT_LT(fall.departure, std::get<SmoothMisfit>(fall.what).before);
    for (const Misfit& misfit : misfits_along(Coordinate::angular_frequency)) {
        EXPECT_TRUE(std::get<SmoothMisfit>(misfit.what).is_the_same);
    }
}

/// Two samples, the second softer by a third: what is told of a departure, its residuals and the curve of the base model on the
/// page refer to one prediction, that with the effect of the sample.
TEST(Localise, DeparturesAreFromTheModelAsFitted) {
    Experiment experiment = both_sweeps();
    experiment.measurements.erase(experiment.measurements.begin());
    experiment.measurements.push_back(experiment.measurements.front());
    experiment.measurements.back().sample = "B";
    for (double& value : experiment.measurements.back().columns.back().values) {
        value *= 0.66;
    }
    const DataSet data = data_set_of(experiment, {.sample = 0.3});
    const Forward forward(experiment, data.observations, simulator());
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const Fit base = inference.fit({});
    const Prediction prediction = inference.prediction(base.model);
    const Eigen::VectorXd fitted = inference.as_fitted(prediction);
    EXPECT_LT((errors.whiten(data.values - fitted) - errors.residual(prediction)).cwiseAbs().maxCoeff(), 1e-8);

    std::vector<Misfit> misfits = localise(inference, base, detect(inference, base, {}, 1, 99));
    std::erase_if(misfits, [](const Misfit& misfit) { return misfit.axis != "strain"; });
    ASSERT_FALSE(misfits.empty());
    double sum = 0;
    double count = 0;
    for (Index k = 0; k < data.size(); ++k) {
        const Observation& one = data.observations[static_cast<std::size_t>(k)];
        const double strain = experiment.measurements[one.measurement].columns[0].values[one.row];
        sum += strain >= misfits.front().from ? one.value / fitted[k] - 1 : 0;
        count += strain >= misfits.front().from ? 1 : 0;
    }
    EXPECT_NEAR(misfits.front().departure, sum / count, 1e-9);
}

}  // namespace
}  // namespace coagula::diagnose
