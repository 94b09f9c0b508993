// SPDX-License-Identifier: GPL-3.0-or-later
// The shear modulus of a bonded network by two ways: the virial of Brownian particles in a slow flow, and the linear solver.
#include <coagula/generators/brownian_dynamics.hpp>
#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

#include "support/brownian_pairs.hpp"
#include "support/lattices.hpp"

#include <cstdio>
#include <vector>

namespace coagula::mechanics {
namespace {

using generators::examples::dlvo;
using generators::examples::radius;
using generators::examples::thermal;

constexpr double rest_gap = 0.004;

/// A crystal of touching spheres that rest at the gap of the potential, of which every ninth is missing: its particles move against
/// the strain, and nothing is stressed at the start.
Packing holed_crystal() {
    const Packing whole = coagula::testing::make_lattice(coagula::testing::face_centred_cubic(), 4, 4, 4, radius);
    constexpr double apart = 1 + rest_gap / 2;
    std::vector<Index> kept;
    for (Index particle = 0; particle < whole.size(); ++particle) {
        if (random_uniform(4, RandomPurpose::test, 0, static_cast<std::uint64_t>(particle))[0] > 1.0 / 9) {
            kept.push_back(particle);
        }
    }
    return {Cell::periodic(apart * whole.cell.lengths()), apart * whole.positions(Eigen::all, kept), whole.radii(kept)};
}

/// Stress over strain at the end of a slow quarter of an oscillation, where the flow rests.
double modulus_by_flow(const Packing& packing, double tangential_stiffness) {
    constexpr int steps = 400;
    constexpr double strain = 1e-4;
    const generators::PairPotential potential = dlvo(0);
    generators::BrownianOptions options;
    options.temperature = 1e-7;
    options.cutoff_gap = 0.3 * radius;  // the nearest only
    if (tangential_stiffness > 0) {
        options.resistance.tangential_stiffness = tangential_stiffness;
    }
    options.time_step = generators::choose_time_step(potential, radius, rest_gap * radius, options).time_step;
    options.stop_time = steps * options.time_step;
    options.sample_interval = options.time_step;
    options.flow = {.amplitude = strain, .frequency = 1 / (4 * options.stop_time)};
    const generators::BrownianRun run = generators::simulate_brownian(packing, potential, options);
    const generators::StressSeries& stress = run.series.stress;
    EXPECT_NEAR(stress.strain.back(), strain, 1e-12);
    return (stress.shear_stress.back() - stress.shear_stress.front()) / stress.strain.back();
}

TEST(BrownianModulus, StressOfASmallStrainIsThatOfTheLinearSolver) {
    const Packing packing = holed_crystal();
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const double stiffness = dlvo(0).contact().stiffness;
    for (const double share : {0.0, 0.25}) {
        LinearOptions options;  // particle stiffnesses: two in series make a contact
        options.normal_stiffness = 2 * stiffness;
        options.shear_stiffness = 2 * share * stiffness;
        const double expected = solve_linear(packing, bonds, options).shear_modulus(2, 0);
        const double found = modulus_by_flow(packing, share * stiffness);
        std::printf("tangential over normal stiffness %.2f: modulus by the flow over that of the linear solver %.5f\n", share,
                    found / expected);
        EXPECT_NEAR(found / expected, 1, 5e-3);
    }
}

}  // namespace
}  // namespace coagula::mechanics
