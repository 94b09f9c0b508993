// SPDX-License-Identifier: GPL-3.0-or-later
// The explicit rheometer against the linear and the frequency solver, and what it promises.
#include <coagula/common/random.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "support/lattices.hpp"

#include "diluted_crystal.hpp"
#include "explicit/plates.hpp"

namespace coagula::mechanics {
namespace {

/// A small structure, bonded also over gaps so that few soft modes make short runs inaccurate.
struct Sample {
    Packing packing;
    ContactNetwork bonds;
};

const Sample& sample() {
    static const Sample made = [] {
        generators::VoidExpansionOptions options;
        options.particles = 150;
        options.voids = 75;
        options.volume_fraction = 0.4;
        options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
        const Packing packing = generators::expand_voids(options).packing;
        return Sample{packing, find_contacts(packing, 0.12)};
    }();
    return made;
}

RheometerOptions gentle() {
    RheometerOptions options;
    options.boundary = RheometerBoundary::periodic;
    options.amplitude = 1e-5;
    options.growing = false;
    options.oscillations = 1;
    options.compare_with_rest = false;
    return options;
}

RheometerResult run(const RheometerOptions& options, const ShearOrientation& orientation = {2, 0}) {
    return run_rheometer(sample().packing, sample().bonds, options, {orientation});
}

TEST(Rheometer, AgreesWithTheLinearSolverInEveryOrientation) {
    RheometerOptions options = gentle();
    options.oscillations = 2;
    const LinearResponse linear = solve_linear(sample().packing, sample().bonds);
    const RheometerResult result = run_rheometer(sample().packing, sample().bonds, options, all_orientations());
    ASSERT_EQ(result.runs.size(), 6U);
    for (const RheometerRun& one : result.runs) {
        const double expected = linear.shear_modulus(one.orientation.normal, one.orientation.direction);
        EXPECT_NEAR(one.oscillations.back().storage_modulus / expected, 1, 0.005);
        EXPECT_LT(std::abs(one.oscillations.back().phase), 0.02);
    }
}

const coagula::testing::DilutedCrystal& firm_sample() {
    static const coagula::testing::DilutedCrystal made;
    return made;
}

/// Inertia changes the stress in proportion to the square of the rate.
TEST(Rheometer, ConvergesToTheLinearSolverAsTheRateFalls) {
    const LinearResponse response = solve_linear(firm_sample().packing, firm_sample().bonds);
    ASSERT_EQ(response.floppy_modes, 0);
    const double linear = response.shear_modulus(2, 0);
    RheometerOptions options = gentle();
    options.compare_with_rest = true;
    options.oscillations = 2;  // what the start sets in motion dies down in the first
    std::array<double, 3> error{};
    double rate = 1;
    for (std::size_t k = 0; k < error.size(); ++k) {
        options.steps_per_oscillation = k == 0 ? 600 : k == 1 ? 2400 : 9600;
        const RheometerResult result = run_rheometer(firm_sample().packing, firm_sample().bonds, options, {{2, 0}});
        EXPECT_LT(result.inertial_number, rate);
        rate = result.inertial_number;
        const RheometerRun& one = result.runs[0];
        error[k] = one.oscillations.back().fundamental_storage / linear - 1;
        EXPECT_NEAR(one.rest_modulus / linear, 1, 2e-5);  // at rest there is no rate
        if (k > 0) {
            EXPECT_NEAR(std::log(error[k - 1] / error[k]) / std::log(4), 2, 0.1);
            // At the peak itself the error is smaller: there particles slow down, and local damping makes them light.
            EXPECT_NEAR(one.rate_error, one.oscillations.back().storage_modulus / linear - 1, 5e-6);
            EXPECT_LT(std::abs(one.rate_error), 0.2 * std::abs(error[k]));
        }
    }
    EXPECT_LT(std::abs(error[2]), 1e-4);
}

/// Local damping holds back what becomes faster more than what becomes slower. The unbalanced force, m a / (1 - alpha) or m a / (1
/// + alpha), therefore has a part in phase with the velocity, in proportion to the scaled mass, that is to steps^-2, and about to
/// the difference of the two, alpha / (1 - alpha^2).
TEST(Rheometer, OwesThePhaseOfSpringsToScaledMassAndLocalDamping) {
    const auto phase = [](int steps, double damping) {
        RheometerOptions options = gentle();
        options.boundary = RheometerBoundary::plates;
        options.oscillations = 2;
        options.steps_per_oscillation = steps;
        options.damping = damping;
        return run_rheometer(firm_sample().packing, firm_sample().bonds, options, {{2, 0}}).runs[0].oscillations.back().phase;
    };
    const double coarse = phase(2400, 0.9);
    const double fine = phase(9600, 0.9);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4), 2, 0.3);
    EXPECT_LT(fine, 1e-4 * std::numbers::pi);  // the bound of the paper, sec. 3.1
    const auto difference = [](double damping) { return damping / (1 - damping * damping); };
    EXPECT_NEAR(phase(2400, 0.5) / coarse, difference(0.5) / difference(0.9), 0.4 * difference(0.5) / difference(0.9));
}

TEST(Rheometer, HasTheComplexModulusOfTheFrequencySolver) {
    RheometerOptions options = gentle();
    options.model.normal_viscosity = 0.15;
    options.model.shear_viscosity = 0.03;
    options.model.normal_maxwell_stiffness = 20;
    options.model.normal_maxwell_time = 0.1;
    options.model.shear_maxwell_stiffness = 3;
    options.model.shear_maxwell_time = 0.3;
    options.model.solvent_viscosity = 2e4;
    options.damping = 0;
    options.oscillations = 3;
    options.steps_per_oscillation = 20000;
    const double frequency = 1;
    const auto exact = solve_frequency_sweep(sample().packing, sample().bonds, options.model, {&frequency, 1});
    const std::complex<double> modulus = exact.points[0].shear_modulus(2, 0);
    const Oscillation last = run(options).runs[0].oscillations.back();
    EXPECT_GT(modulus.imag(), 0.2 * modulus.real());
    EXPECT_NEAR(last.fundamental_storage / modulus.real(), 1, 0.01);
    EXPECT_NEAR(last.fundamental_loss / modulus.imag(), 1, 0.01);
    EXPECT_NEAR(last.phase, std::arg(modulus), 0.005);
}

TEST(Rheometer, MeasuresTheSameStressInTheVolumeAndOnThePlate) {
    RheometerOptions options = gentle();
    options.boundary = RheometerBoundary::plates;
    options.oscillations = 2;
    options.steps_per_oscillation = 9600;
    const RheometerRun one = run(options, {1, 2}).runs[0];
    const double whole = one.oscillations.back().fundamental_storage;
    EXPECT_NEAR(one.plate_storage / whole, 1, 0.01);
    // Plates hold the particles next to them.
    EXPECT_GT(whole, solve_linear(sample().packing, sample().bonds).shear_modulus(1, 2));
}

/// In a crystal every particle carries the same stress, so the few in a measurement sphere stand for all.
TEST(Rheometer, MeasuresTheStressInSpheres) {
    const Packing crystal = coagula::testing::make_lattice(coagula::testing::face_centred_cubic(), 3, 3, 4);
    const ContactNetwork bonds = find_contacts(crystal, 0.01);
    RheometerOptions options = gentle();
    options.boundary = RheometerBoundary::plates;
    options.plate_layers = 1;
    const RheometerRun one = run_rheometer(crystal, bonds, options, {{2, 0}}).runs[0];
    ASSERT_EQ(one.sphere_storage.size(), 5);
    const double whole = one.oscillations[0].fundamental_storage;
    for (const double sphere : one.sphere_storage) {
        EXPECT_NEAR(sphere / whole, 1, 0.06);  // two dozen particles, cut by the sphere
    }
    EXPECT_NEAR(one.sphere_storage.mean() / whole, 1, 0.02);
}

TEST(Mount, RepeatsTheStructureInThePlates) {
    RheometerOptions options;
    const Packing& packing = sample().packing;
    const MountedSample mounted = mount(packing, sample().bonds, options, {2, 0});
    const double height = packing.cell.lengths().z();
    const double thickness = 6 * 0.25e-6;
    ASSERT_EQ(mounted.packing.size(), packing.size() + static_cast<Index>(mounted.lower.size() + mounted.upper.size()));
    const auto expected = std::count_if(packing.positions.row(2).begin(), packing.positions.row(2).end(),
                                        [&](double z) { return z >= height - thickness; });
    EXPECT_EQ(static_cast<Index>(mounted.lower.size()), expected);
    for (const Index particle : mounted.upper) {
        EXPECT_GE(mounted.packing.positions(2, particle), mounted.bottom + height);
        EXPECT_LT(mounted.packing.positions(2, particle), mounted.bottom + height + thickness);
    }
    // Every bond with an end in the sample, no bond inside a plate; those through the plates twice.
    Index crossing = 0;
    for (Index bond = 0; bond < sample().bonds.size(); ++bond) {
        const double direct =
            packing.positions(2, sample().bonds.ends(1, bond)) - packing.positions(2, sample().bonds.ends(0, bond));
        crossing += std::abs(sample().bonds.branch(2, bond) - direct) > 0.5 * height ? 1 : 0;
    }
    EXPECT_GT(crossing, 10);
    EXPECT_EQ(mounted.bonds.size(), sample().bonds.size() + crossing);
    for (Index bond = 0; bond < mounted.bonds.size(); ++bond) {
        const Eigen::Vector3d between =
            mounted.packing.positions.col(mounted.bonds.ends(1, bond)) - mounted.packing.positions.col(mounted.bonds.ends(0, bond));
        EXPECT_LT((mounted.packing.cell.minimum_image(between) - mounted.bonds.branch.col(bond)).norm(), 1e-18);
    }
}

TEST(Rheometer, GoesOnFromACheckpointToTheSameBits) {
    RheometerOptions options = gentle();
    options.growing = true;
    options.oscillations = 3;
    options.steps_per_oscillation = 600;
    options.model.friction = 0.3;
    options.model.normal_strength = 3e-11;
    options.compare_with_rest = true;
    const std::vector<ShearOrientation> two{{2, 0}, {0, 1}};
    std::vector<RheometerCheckpoint> checkpoints;
    RheometerControl control;
    control.on_checkpoint = [&](const RheometerCheckpoint& checkpoint) { checkpoints.push_back(checkpoint); };
    const RheometerResult whole = run_rheometer(sample().packing, sample().bonds, options, two, {}, control);
    ASSERT_EQ(checkpoints.size(), 6U);
    for (const std::size_t from : {1U, 2U, 4U}) {
        RheometerControl again;
        again.resume = &checkpoints[from];
        const RheometerResult rest = run_rheometer(sample().packing, sample().bonds, options, two, {}, again);
        ASSERT_EQ(rest.runs.size(), 2U);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(rest.runs[k].stress, whole.runs[k].stress);
            EXPECT_EQ(rest.runs[k].broken.size(), whole.runs[k].broken.size());
            EXPECT_EQ(rest.runs[k].rate_error, whole.runs[k].rate_error);
        }
    }
    EXPECT_GT(whole.runs[0].broken.size(), 0U);
}

TEST(Rheometer, HasTheSameBitsForAnyNumberOfThreads) {
    Packing packing =
        coagula::testing::make_lattice(coagula::testing::body_centred_cubic(), 10, 10, 10);  // enough for several chunks
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d shift = 2e-8 * random_uniform(1, RandomPurpose::test, 0, static_cast<std::uint64_t>(particle));
        packing.positions.col(particle) = packing.cell.wrap(packing.positions.col(particle) + shift);
    }
    const ContactNetwork bonds = find_contacts(packing, 0.02);
    RheometerOptions options = gentle();
    options.steps_per_oscillation = 200;
    const int threads = omp_get_max_threads();
    std::vector<std::vector<double>> stress;
    for (const int count : {1, 2}) {
        omp_set_num_threads(count);
        stress.push_back(run_rheometer(packing, bonds, options, {{2, 0}}).runs[0].stress);
    }
    omp_set_num_threads(threads);
    EXPECT_EQ(stress[0], stress[1]);
}

TEST(Rheometer, BreaksBondsAboveTheirStrengthAndLosesStiffness) {
    RheometerOptions options = gentle();
    options.oscillations = 2;
    options.steps_per_oscillation = 2400;
    options.model.normal_strength = 1;
    const RheometerRun strong = run(options).runs[0];
    EXPECT_TRUE(strong.broken.empty());
    options.model.normal_strength = 3e-11;
    const RheometerRun weak = run(options).runs[0];
    ASSERT_GT(weak.broken.size(), 3U);
    EXPECT_LT(weak.oscillations.back().storage_modulus, 0.97 * strong.oscillations.back().storage_modulus);
    std::set<std::pair<Index, Index>> pairs;
    Index counted = 0;
    for (const BrokenInShear& bond : weak.broken) {
        EXPECT_LE(std::abs(bond.strain), options.amplitude);
        pairs.insert({bond.first, bond.second});
    }
    for (const Oscillation& oscillation : weak.oscillations) {
        counted += oscillation.broken_bonds;
    }
    EXPECT_EQ(pairs.size(), weak.broken.size());
    EXPECT_EQ(counted, static_cast<Index>(weak.broken.size()));
}

TEST(Rheometer, BreaksNothingInAnOscillationThatHolds) {
    RheometerOptions options = gentle();
    options.amplitude = 2e-3;
    options.model.normal_strength = options.model.shear_strength = 2e-9;
    options.course = {{0.01}, {1, false}, {1}};
    options.oscillations = 3;
    const auto weak = run(options).runs[0];
    options.model.normal_strength = options.model.shear_strength = unset;
    const auto strong = run(options).runs[0];
    ASSERT_EQ(weak.oscillations[0].broken_bonds, 0);
    EXPECT_EQ(weak.oscillations[1].broken_bonds, 0);
    EXPECT_EQ(weak.oscillations[1].fundamental_storage, strong.oscillations[1].fundamental_storage);
    EXPECT_EQ(weak.oscillations[1].fundamental_loss, strong.oscillations[1].fundamental_loss);
    EXPECT_GT(weak.oscillations[2].broken_bonds, 10);
    EXPECT_EQ(weak.broken.front().oscillation, 2);
}

/// The fast way and the general one break the same bonds, until rounding tells their avalanches apart.
TEST(Rheometer, BreaksTheSameBondsEitherWay) {
    RheometerOptions options = gentle();
    options.steps_per_oscillation = 2400;
    options.model.normal_strength = 3e-11;
    options.model.shear_strength = 2e-11;
    const RheometerRun fast = run(options).runs[0];
    options.model.friction = 0;  // makes it general
    const RheometerRun general = run(options).runs[0];
    ASSERT_GT(fast.broken.size(), 3U);
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(fast.broken[k].first, general.broken[k].first);
        EXPECT_EQ(fast.broken[k].second, general.broken[k].second);
        EXPECT_EQ(fast.broken[k].strain, general.broken[k].strain);
        EXPECT_EQ(fast.broken[k].cause, general.broken[k].cause);
    }
    EXPECT_NEAR(static_cast<double>(fast.broken.size()), static_cast<double>(general.broken.size()), 5);
    EXPECT_NEAR(fast.oscillations[0].storage_modulus / general.oscillations[0].storage_modulus, 1, 0.04);
}

/// One limit within reach, the others far: the fast way and the general one, and the limits that only the general one knows.
TEST(Rheometer, SaysWhyEachBondBroke) {
    const auto causes = [](const ContactModel& model) {
        RheometerOptions options = gentle();
        options.steps_per_oscillation = 1200;
        options.model = model;
        std::set<BreakageCause> found;
        const RheometerRun sheared = run(options).runs[0];
        for (const BrokenInShear& bond : sheared.broken) {
            found.insert(bond.cause);
        }
        return found;
    };
    using Causes = std::set<BreakageCause>;
    const RheometerOptions common = gentle();
    for (const double friction : {unset, 0.0}) {  // the second makes it general
        ContactModel model = common.model;
        model.friction = friction;
        model.normal_strength = 3e-11;
        model.shear_strength = 1;
        EXPECT_EQ(causes(model), Causes{BreakageCause::normal});
        model.normal_strength = 1;
        model.shear_strength = 1e-11;
        EXPECT_EQ(causes(model), Causes{BreakageCause::shear});
    }
    ContactModel moments = common.model;
    moments.bending_stiffness = moments.twisting_stiffness = 1e-13;
    moments.normal_strength = moments.shear_strength = 1;
    moments.bending_strength = 3e-19;
    EXPECT_EQ(causes(moments), Causes{BreakageCause::bending});
}

TEST(Rheometer, AgesBetweenOscillations) {
    RheometerOptions options = gentle();
    options.oscillations = 3;
    options.model.ageing_rate = 0.2;
    options.model.ageing_time = 0.5;
    options.frequency = 2;
    const RheometerRun one = run(options).runs[0];
    const double fresh = one.oscillations[0].fundamental_storage;
    EXPECT_NEAR(one.oscillations[1].fundamental_storage / fresh, 1 + 0.2 * std::log(2), 0.01);
    EXPECT_NEAR(one.oscillations[2].fundamental_storage / fresh, 1 + 0.2 * std::log(3), 0.01);
}

TEST(Rheometer, HasNoModulusWithoutBonds) {
    Packing apart = coagula::testing::make_lattice(coagula::testing::simple_cubic(), 3, 3, 3);
    apart.radii *= 0.9;
    ContactNetwork none;
    none.particles = apart.size();
    none.ends.resize(2, 0);
    none.branch.resize(3, 0);
    RheometerOptions options = gentle();
    options.steps_per_oscillation = 200;
    const RheometerResult result = run_rheometer(apart, none, options, {{2, 0}});
    EXPECT_EQ(result.storage_modulus(), 0);
    EXPECT_EQ(result.phase(), 0);
}

TEST(Rheometer, RejectsImpossibleOptions) {
    const auto refused = [](auto change) {
        RheometerOptions options = gentle();
        change(options);
        EXPECT_THROW(run(options), std::invalid_argument);
    };
    refused([](RheometerOptions& o) { o.amplitude = 0; });
    refused([](RheometerOptions& o) { o.frequency = -1; });
    refused([](RheometerOptions& o) { o.oscillations = 0; });
    refused([](RheometerOptions& o) { o.damping = 1; });
    refused([](RheometerOptions& o) { o.steps_per_oscillation = 150; });
    refused([](RheometerOptions& o) { o.samples_per_oscillation = 7; });
    refused([](RheometerOptions& o) { o.course = {{1}, {1}}; });
    refused([](RheometerOptions& o) { o.course = {{0, false}}; });
    refused([](RheometerOptions& o) { o.model.normal_stiffness = -1; });
    refused([](RheometerOptions& o) {
        o.model.normal_springpot_stiffness = 1;
        o.model.normal_springpot_time = 1;
        o.model.normal_springpot_exponent = 0.5;
    });
    EXPECT_THROW(run(gentle(), {1, 1}), std::invalid_argument);
    const Packing open{Cell::open({0, 0, 0}, {1, 1, 1}), sample().packing.positions, sample().packing.radii};
    EXPECT_THROW(run_rheometer(open, sample().bonds, gentle(), {{2, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
