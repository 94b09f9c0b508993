// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli and third harmonic of waveforms that are known.
#include <coagula/diagnose/waveform.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace coagula::diagnose {
namespace {

using std::numbers::pi;

constexpr double frequency_of_waveform = 10;  // rad/s

/// @param times [s]. @param stress of the phase w t.
template <class Strain, class Stress>
Measurement waveform(const std::vector<double>& times, const Strain& strain, const Stress& stress) {
    Measurement table;
    table.kind = MeasurementKind::waveform;
    table.columns = {{"time", "s", times},
                     {"strain", "1", {}},
                     {"stress", "Pa", {}},
                     {"angular_frequency", "rad/s", std::vector<double>(times.size(), frequency_of_waveform)}};
    for (const double time : times) {
        table.columns[1].values.push_back(strain(frequency_of_waveform * time));
        table.columns[2].values.push_back(stress(frequency_of_waveform * time));
    }
    return table;
}

std::vector<double> steps(double periods, int count) {
    std::vector<double> times;
    for (int k = 0; k < count; ++k) {
        times.push_back(2 * pi / frequency_of_waveform * periods * k / count);
    }
    return times;
}

/// Uneven samples of a period and a half, an offset, and a strain that does not start at zero.
TEST(Waveform, HasTheModuliItWasMadeWith) {
    std::vector<double> times = steps(1.5, 90);
    for (double& time : times) {
        time += 0.003 * std::sin(40 * time);
    }
    const Measurement table = waveform(
        times, [](double phase) { return 0.02 * std::sin(phase + 0.7) + 0.001; },
        [](double phase) {
            const double here = phase + 0.7;
            return 0.02 * (500 * std::sin(here) + 80 * std::cos(here) + 30 * std::sin(3 * here) - 40 * std::cos(3 * here)) + 3;
        });
    const auto found = harmonics_of(table);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->strain, 0.02, 1e-10);
    EXPECT_EQ(found->angular_frequency, frequency_of_waveform);
    EXPECT_NEAR(found->storage_modulus, 500, 1e-6);
    EXPECT_NEAR(found->loss_modulus, 80, 1e-6);
    EXPECT_NEAR(found->third_harmonic, 50 / std::hypot(500, 80), 1e-8);
}

/// Stress of a plastic body: in phase with the rate, 4/pi of its height in the first harmonic, a third of that in the third.
TEST(Waveform, OfARectangleHasAThirdOfTheFirst) {
    const auto sign = [](double phase) { return std::cos(phase) > 0 ? 7.0 : -7.0; };
    const auto found = harmonics_of(waveform(
        steps(1, 4000), [](double phase) { return 0.1 * std::sin(phase); }, sign));
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->storage_modulus, 0, 0.1);
    EXPECT_NEAR(found->loss_modulus, 4 / pi * 70, 0.1);
    EXPECT_NEAR(found->third_harmonic, 1.0 / 3, 1e-3);
}

TEST(Waveform, LeftOutCellsDoNotCount) {
    const auto sine = [](double phase) { return std::sin(phase); };
    Measurement table = waveform(steps(1, 40), sine, sine);
    for (std::size_t row = 3; row < 20; row += 5) {
        table.columns[2].values[row] = unset;
    }
    const auto found = harmonics_of(table);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->storage_modulus, 1, 1e-9);
    EXPECT_NEAR(found->third_harmonic, 0, 1e-9);
}

TEST(Waveform, SaysNothingWhereNothingFollows) {
    const auto sine = [](double phase) { return std::sin(phase); };
    EXPECT_FALSE(harmonics_of(waveform(steps(1, 10), sine, sine)).has_value());
    EXPECT_FALSE(harmonics_of(waveform(steps(0.8, 100), sine, sine)).has_value());
    EXPECT_FALSE(harmonics_of(waveform(steps(1, 100), sine, [](double) { return 0.0; })).has_value());
    EXPECT_FALSE(harmonics_of(waveform(
                                  steps(1, 100), [](double) { return 0.0; }, sine))
                     .has_value());
    Measurement table = waveform(steps(1, 100), sine, sine);
    table.columns.pop_back();  // the frequency
    EXPECT_FALSE(harmonics_of(table).has_value());
    EXPECT_FALSE(harmonics_of(Measurement{}).has_value());
}

}  // namespace
}  // namespace coagula::diagnose
