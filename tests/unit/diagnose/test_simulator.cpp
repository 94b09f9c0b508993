// SPDX-License-Identifier: GPL-3.0-or-later
// Several threads ask one simulator: each result is simulated once, by itself, and is the same for any number of them.
#include "hidden_effects.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <complex>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::diagnose {
namespace {

/// So many threads while it lives.
class Threads {
public:
    explicit Threads(int count) { omp_set_num_threads(count); }
    ~Threads() { omp_set_num_threads(before_); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

private:
    int before_ = omp_get_max_threads();
};

Simulator of_one_structure(SimulationCache& cache) {
    return {{structure(64, 1)}, {"one"}, cache};
}

TEST(Simulator, SimulatesOneAfterTheOther) {
    const Threads three(3);
    SimulationCache cache;
    Simulator simulator = of_one_structure(cache);
    std::atomic<int> running = 0;
    std::atomic<int> simulated = 0;
    const auto run = [&](const Packing&) {
        EXPECT_EQ(++running, 1);
        --running;
        return std::vector<double>{static_cast<double>(++simulated)};
    };
    std::vector<double> found(40, 0.0);
    simulator.together(found.size(), [&](std::size_t k) {
        const std::vector<double> key{static_cast<double>(k % 5)};
        found[k] = simulator.remembered({"twice", 0, key}, [&] {
            return 2 * simulator.simulated({"number", 0, key}, 1, run).front();
        });
    });
    EXPECT_EQ(simulated, 5);
    for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(found[k], 2 * (1 + static_cast<double>(k % 5))) << "simulations come in the order of the work";
    }
}

TEST(Simulator, SimulatesAgainAfterWorkThatFailed) {
    const Threads three(3);
    SimulationCache cache;
    Simulator simulator = of_one_structure(cache);
    const auto fail = [](std::size_t k) {
        if (k == 1) {
            throw std::runtime_error("the work failed");
        }
    };
    EXPECT_THROW(simulator.together(3, fail), std::runtime_error);
    EXPECT_EQ(simulator.simulated({"number"}, 1, [](const Packing&) { return std::vector<double>{7}; }).front(), 7);
}

/// A sweep whose loss rises with the frequency and has a maximum, which two causes explain better than one.
Measurement rising_loss(const std::string& sample, std::uint64_t seed) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 300, 14);
    std::vector<std::complex<double>> moduli;
    for (const double frequency : frequencies) {
        const std::complex<double> relaxing(0, frequency / 3);
        moduli.push_back(1e5 * (1.0 + 0.2 * relaxing / (1.0 + relaxing) + std::complex<double>(0, 1e-3 * frequency)));
    }
    Measurement table{.kind = MeasurementKind::frequency_sweep, .label = sample, .sample = sample, .columns = {}, .left_out = {}};
    table.columns = {{"strain", "1", std::vector<double>(frequencies.size(), 1e-5)}, {"angular_frequency", "rad/s", frequencies}};
    add_moduli(table, moduli, 0.01, seed);
    return table;
}

Diagnosis by_threads(int threads) {
    const Threads these(threads);
    SimulationCache cache;
    Simulator simulator = of_one_structure(cache);
    Experiment experiment;
    experiment.instrument.geometry = Geometry::plate_plate;
    experiment.instrument.plate_radius = 0.0125;
    experiment.instrument.gap = 1e-3;
    experiment.measurements = {rising_loss("one", 3), rising_loss("other", 4)};
    DiagnosisOptions options;
    options.bootstrap = 199;
    options.causes = {"contact-loss", "contact-dashpot", "contact-relaxation", "tool-inertia"};
    return diagnose(experiment, simulator, options);
}

TEST(Diagnosis, DoesNotDependOnTheNumberOfThreads) {
    const Diagnosis alone = by_threads(1);
    const Diagnosis together = by_threads(3);
    ASSERT_TRUE(alone.detected);
    ASSERT_EQ(alone.causes.size(), together.causes.size());
    EXPECT_TRUE(std::any_of(alone.causes.begin(), alone.causes.end(), [](const Cause& one) { return one.set.members.size() > 1; }));
    for (std::size_t k = 0; k < alone.causes.size(); ++k) {
        EXPECT_EQ(alone.causes[k].name(), together.causes[k].name());
        EXPECT_EQ(alone.causes[k].posterior, together.causes[k].posterior) << alone.causes[k].name();
    }
    EXPECT_EQ(alone.gain.elpd_difference, together.gain.elpd_difference);
    EXPECT_EQ(alone.gain.elpd_low, together.gain.elpd_low);
    EXPECT_EQ(alone.p_value, together.p_value);
}

}  // namespace
}  // namespace coagula::diagnose
