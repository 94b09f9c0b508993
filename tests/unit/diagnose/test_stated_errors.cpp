#include <coagula/common/random.hpp>
#include <coagula/diagnose/stated_errors.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace coagula::diagnose {
namespace {

constexpr std::size_t rows = 40;
constexpr std::array offsets{0.6, 1.0, 1.4};

/// Three samples of one modulus, apart by their offsets, each with errors of 2 % of its own level.
Experiment apart() {
    Experiment experiment;
    for (std::size_t sample = 0; sample < offsets.size(); ++sample) {
        Measurement table;
        table.kind = MeasurementKind::amplitude_sweep;
        table.label = table.sample = "sample " + std::to_string(sample);
        Column strain{"strain", "1", {}};
        Column storage{"storage_modulus", "Pa", {}};
        for (std::size_t row = 0; row < rows; ++row) {
            strain.values.push_back(1e-4 * std::pow(1.1, static_cast<double>(row)));
            storage.values.push_back(1000 * offsets[sample] * (1 + 0.02 * random_normal(1, RandomPurpose::test, row, sample).x()));
        }
        table.columns = {strain, storage};
        experiment.measurements.push_back(table);
    }
    return experiment;
}

TEST(StatedErrors, AreInProportionToTheLevelOfTheirSample) {
    Experiment experiment = apart();
    std::vector<NoiseModel> models;
    for (const Replicates& replicates : find_replicates(experiment.measurements)) {
        models.push_back(fit_noise(replicates));
    }
    ASSERT_EQ(models.size(), 1U);
    state_errors(experiment, models);
    for (std::size_t sample = 0; sample < offsets.size(); ++sample) {
        const Column& storage = *find_column(experiment.measurements[sample], "storage_modulus");
        ASSERT_EQ(storage.standard_errors.size(), rows);
        for (const double error : storage.standard_errors) {
            // 78 degrees of freedom: 8 %; the levels of a row and of a sample 1.2 % and 0.3 %.
            EXPECT_NEAR(error / (20 * offsets[sample]), 1, 0.25) << "sample " << sample;
        }
    }
}

TEST(StatedErrors, OfTheTableAreKept) {
    Experiment experiment = apart();
    experiment.measurements[1].columns[1].standard_errors.assign(rows, 7.0);
    const NoiseModel model = fit_noise(find_replicates(experiment.measurements).front());
    state_errors(experiment, {model});
    EXPECT_EQ(experiment.measurements[1].columns[1].standard_errors, std::vector<double>(rows, 7.0));
    EXPECT_EQ(experiment.measurements[0].columns[1].standard_errors.size(), rows);
}

}  // namespace
}  // namespace coagula::diagnose
