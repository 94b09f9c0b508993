// The stabilised step: what its paper proves about linear modes.
#include "step_scheme.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace coagula::generators {
namespace {

/// One step of a linear mode x' = -q x with unit time step: what becomes of x and of the noise.
struct Response {
    double position;
    double noise;
};

Response respond(const StepScheme& scheme, double q) {
    const auto run = [&](double x, double noise) {
        double previous = x;
        double current = x;
        for (std::size_t stage = 0; stage < scheme.stages.size(); ++stage) {
            const StageWeights& weights = scheme.stages[stage];
            const double at = stage == 0 ? x + scheme.evaluation * noise : current;
            const double force = -q * at * weights.force;
            const double next =
                stage == 0 ? x + force + weights.noise * noise : force + weights.current * current + weights.previous * previous;
            previous = current;
            current = next;
        }
        return current;
    };
    return {run(1, 0), run(0, 1)};
}

TEST(StepScheme, DecaysToFirstOrderAndSecondOrderForWeakModes) {
    for (const int stages : {1, 2, 5, 9}) {
        const Response weak = respond(stabilised_scheme(stages), 1e-4);
        EXPECT_NEAR(weak.position, 1 - 1e-4, 1e-8);
        EXPECT_NEAR(weak.noise, 1, 1e-3);
    }
}

TEST(StepScheme, IsStableUpToItsBoundAndNotBeyond) {
    for (const int stages : {1, 2, 5, 12}) {
        const StepScheme scheme = stabilised_scheme(stages);
        EXPECT_GT(scheme.stability, (2 - 4.0 / 3 * 0.005) * stages * stages * 0.99);
        for (double q = 0.01; q < 1; q += 0.01) {
            EXPECT_LT(std::abs(respond(scheme, q * scheme.stability).position), 1) << stages << " stages, " << q;
        }
        EXPECT_GT(std::abs(respond(scheme, 1.1 * scheme.stability).position), 1);
    }
    EXPECT_LT(std::abs(respond(euler_maruyama(), 1.99).position), 1);
    EXPECT_GT(std::abs(respond(euler_maruyama(), 2.01).position), 1);
}

TEST(StepScheme, GivesModesTheirTemperature) {
    // Variance over the exact 1/(2 q) after the postprocessor: exact without damping, even for stiff modes; close to it with.
    const auto equipartition = [](const StepScheme& scheme, double q) {
        const Response mode = respond(scheme, q);
        const double variance = mode.noise * mode.noise / (1 - mode.position * mode.position);
        return 2 * q * (variance + scheme.observation * scheme.observation);
    };
    for (const int stages : {1, 3, 7}) {
        const StepScheme undamped = stabilised_scheme(stages, 0);
        for (const double share : {0.01, 0.1, 0.37, 0.6}) {
            EXPECT_NEAR(equipartition(undamped, share * undamped.stability), 1, 1e-9);
        }
        const StepScheme damped = stabilised_scheme(stages);
        EXPECT_NEAR(equipartition(damped, 0.02), 1, 1e-3);
        EXPECT_NEAR(equipartition(damped, 0.1 * damped.stability), 1, 0.04);
    }
    // Euler-Maruyama heats them: 1/(1 - q/2).
    EXPECT_NEAR(equipartition(euler_maruyama(), 0.4), 1 / (1 - 0.2), 1e-12);
}

}  // namespace
}  // namespace coagula::generators
