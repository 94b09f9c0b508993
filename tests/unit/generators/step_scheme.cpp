// SPDX-License-Identifier: GPL-3.0-or-later
// The stabilised step: what its paper proves about linear modes.
#include "step_scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::generators {
namespace {

/// One step of a linear mode x' = -q x with unit time step: what becomes of x and of the two noises.
struct Response {
    double position;
    double noise;
    double second_noise;
};

Response respond(const StepScheme& scheme, double q) {
    const auto run = [&](double x, double noise, double second_noise) {
        double before = x;
        double latest = x + scheme.evaluation * noise;
        for (const StageWeights& weights : scheme.stages) {
            const double next = -q * latest * weights.force + weights.current * latest + weights.previous * before +
                                weights.noise * noise + weights.second_noise * second_noise;
            before = &weights == &scheme.stages.front() ? x : latest;
            latest = next;
        }
        return latest;
    };
    return {run(1, 0, 0), run(0, 1, 0), run(0, 0, 1)};
}

/// Variance of the observed mode over the exact 1/(2 q).
double equipartition(const StepScheme& scheme, double q) {
    const Response mode = respond(scheme, q);
    const double noise = mode.noise * mode.noise + mode.second_noise * mode.second_noise;
    return 2 * q * (noise / (1 - mode.position * mode.position) + scheme.observation * scheme.observation);
}

TEST(StepScheme, DecaysToFirstOrderAndSecondOrderForWeakModes) {
    for (const int stages : {1, 2, 5, 9}) {
        const Response weak = respond(stabilised_scheme(stages), 1e-4);
        EXPECT_NEAR(weak.position, 1 - 1e-4, 1e-8);
        EXPECT_NEAR(std::hypot(weak.noise, weak.second_noise), 1, 1e-4);
    }
}

TEST(StepScheme, IsStableUpToItsBoundAndNotBeyond) {
    for (const int stages : {1, 2, 5, 12}) {
        const StepScheme scheme = stabilised_scheme(stages);
        EXPECT_GT(scheme.stability, (2 - 4.0 / 3 * 0.05) * stages * stages * 0.99);
        for (double q = 0.01; q < 1; q += 0.01) {
            EXPECT_LT(std::abs(respond(scheme, q * scheme.stability).position), 1) << stages << " stages, " << q;
        }
        EXPECT_GT(std::abs(respond(scheme, 1.1 * scheme.stability).position), 1);
    }
    EXPECT_LT(std::abs(respond(euler_maruyama(), 1.99).position), 1);
    EXPECT_GT(std::abs(respond(euler_maruyama(), 2.01).position), 1);
}

TEST(StepScheme, GivesEveryModeItsTemperatureWithEveryNumberOfStages) {
    // 30 stages are the most that a run takes. Without a second noise single modes are 95 % too cold, and many stages too hot.
    for (int stages = 1; stages <= 30; ++stages) {
        for (const double damping : {0.005, 0.05, 0.5}) {
            const StepScheme scheme = stabilised_scheme(stages, damping);
            for (int part = 1; part < 3000; ++part) {
                const double q = scheme.stability * part / 3000;
                ASSERT_NEAR(equipartition(scheme, q), 1, 1e-9) << stages << " stages, damping " << damping << ", q " << q;
            }
            ASSERT_NEAR(equipartition(scheme, 1e-3), 1, 1e-8);
        }
    }
    // Euler-Maruyama heats them: 1/(1 - q/2).
    EXPECT_NEAR(equipartition(euler_maruyama(), 0.4), 1 / (1 - 0.2), 1e-12);
}

TEST(StepScheme, IsThePublishedOneWithoutDamping) {
    for (const int stages : {1, 2, 7, 30}) {
        const StepScheme scheme = stabilised_scheme(stages, 0);
        EXPECT_NEAR(scheme.evaluation, 0.5 / stages, 1e-12);
        EXPECT_NEAR(scheme.observation, 0.5 / stages, 1e-12);
        for (const StageWeights& weights : scheme.stages) {
            EXPECT_NEAR(weights.noise, &weights == &scheme.stages.front() ? 1.0 / stages : 0.0, 1e-12);
            EXPECT_NEAR(weights.second_noise, 0, 1e-12);
        }
    }
}

TEST(StepScheme, ForgetsStiffModesWithinSomeSteps) {
    // As few as the damping says, so that what a bond has gained when it forms is gone soon.
    for (int stages = 1; stages <= 30; ++stages) {
        const StepScheme scheme = stabilised_scheme(stages);
        for (int part = 0; part < 2000; ++part) {
            const double q = 0.1 + (scheme.stability - 0.1) * part / 2000;
            ASSERT_LT(std::abs(respond(scheme, q).position), 0.953) << stages << " stages, q " << q;
        }
    }
}

}  // namespace
}  // namespace coagula::generators
