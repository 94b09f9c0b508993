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

    std::vector<std::string> sentences_along(Coordinate coordinate) const {
        std::vector<std::string> sentences;
        for (const Failure& failure : localise(inference_, base_, detection_)) {
            if (failure.axis == name_of(coordinate)) {
                sentences.push_back(failure.sentence);
            }
        }
        return sentences;
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
    ASSERT_FALSE(sentences_along(Coordinate::strain).empty());
    EXPECT_NE(sentences_along(Coordinate::strain).front().find("G' falls relative to the base model along strain"),
              std::string::npos);
    for (const std::string& sentence : sentences_along(Coordinate::angular_frequency)) {
        EXPECT_NE(sentence.find("all along angular frequency"), std::string::npos) << sentence;
    }
}

}  // namespace
}  // namespace coagula::diagnose
