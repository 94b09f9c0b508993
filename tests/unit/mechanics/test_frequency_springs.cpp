// SPDX-License-Identifier: GPL-3.0-or-later
// Bending, twisting, Hertz, JKR, prestress and lubrication in the frequency solver.
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include "networks.hpp"
#include "response/frequency_pairs.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace coagula::mechanics {
namespace {

using coagula::testing::bonds_between;
using coagula::testing::random_spheres;
using Complex = std::complex<double>;

constexpr double full_turn = 2 * std::numbers::pi;

/// Rattlers, spins and floppy modes included; unlike radii.
struct SpringNetwork {
    Packing packing = random_spheres(120, 10.0, 0.25e-6, 21);
    ContactNetwork bonds;

    SpringNetwork() {
        for (Index i = 0; i < packing.size(); ++i) {
            packing.radii[i] *= 0.9 + 0.2 * random_uniform(3, RandomPurpose::test, 1, static_cast<std::uint64_t>(i))[0];
        }
        bonds = find_contacts(packing, 0.02);
    }
    FrequencyPoint at(double frequency, const ContactModel& model, const FrequencyOptions& options = {}) const {
        return solve_frequency_sweep(packing, bonds, model, std::array{frequency}, options).points.at(0);
    }
};

ContactModel with_moments() {
    ContactModel model;
    model.bending_stiffness = 3e-13;
    model.twisting_stiffness = 1e-13;
    return model;
}

ContactModel adhesive() {
    ContactModel model = with_moments();
    model.young_modulus = 70e9;
    model.poisson_ratio = 0.25;
    model.work_of_adhesion = 0.5;
    model.prestress = -2e-8;
    return model;
}

ContactModel lubricated(ContactModel model) {
    model.normal_viscosity = 2e-3;
    model.shear_viscosity = 3e-4;
    model.solvent_viscosity = 1.0;
    model.lubrication_gap = 2e-9;
    model.lubrication_cutoff = 3e-8;
    return model;
}

TEST(FrequencySprings, WithoutLossesItIsTheLinearResponse) {
    const SpringNetwork sample;
    ContactModel bending = with_moments();
    bending.twisting_stiffness = unset;
    for (const ContactModel& model : {with_moments(), bending, adhesive()}) {
        LinearOptions options;
        options.bond_tangents = bond_tangents(sample.packing, sample.bonds, model);
        const LinearResponse linear = solve_linear(sample.packing, sample.bonds, options);
        const FrequencyPoint point = sample.at(10.0, model);
        ASSERT_GT(linear.mean_shear_modulus(), 0);
        EXPECT_LT((point.modulus.real() - linear.elastic_tensor).norm(), 1e-9 * linear.elastic_tensor.norm());
        EXPECT_EQ(point.modulus.imag().cwiseAbs().maxCoeff(), 0);
        EXPECT_NEAR(point.contact_stiffness.normal.real(), linear.contact_normal_stiffness, 1e-9 * linear.contact_normal_stiffness);
    }
}

TEST(FrequencySprings, DoesNotDependOnTheShift) {
    const SpringNetwork sample;
    ContactModel damped = with_moments();
    damped.shear_viscosity = 0.01;
    for (const ContactModel& model : {damped, lubricated(adhesive())}) {
        const FrequencyPoint reference = sample.at(10.0, model);
        const FrequencyPoint other = sample.at(10.0, model, {.shift = 1e-8});
        EXPECT_LT((other.modulus - reference.modulus).norm(), 1e-8 * reference.modulus.norm());
    }
}

/// Those that cannot change the modulus: springs that Hertz's replace, and pairs that come and go one by one.
bool is_idle(const ContactParameter& parameter, const ContactModel& model) {
    const bool linear_spring =
        parameter.value == &ContactModel::normal_stiffness || parameter.value == &ContactModel::shear_stiffness;
    return parameter.value == &ContactModel::lubrication_cutoff || (linear_spring && !std::isnan(model.young_modulus));
}

TEST(FrequencySprings, DerivativesAgreeWithFiniteDifferences) {
    const SpringNetwork sample;
    for (const ContactModel& model : {lubricated(with_moments()), lubricated(adhesive())}) {
        const double frequency = 3e3;
        const auto response = solve_frequency_sweep(sample.packing, sample.bonds, model, std::array{frequency});
        ASSERT_GE(response.parameters.size(), 9U);
        for (std::size_t p = 0; p < response.parameters.size(); ++p) {
            const auto member = response.parameters[p].value;
            const double step = 3e-4 * model.*member;
            ContactModel more = model;
            ContactModel less = model;
            more.*member += step;
            less.*member -= step;
            const ComplexTensor slope = (sample.at(frequency, more).modulus - sample.at(frequency, less).modulus) / (2 * step);
            const ComplexTensor& found = response.points[0].derivative[p];
            if (is_idle(response.parameters[p], model)) {
                EXPECT_EQ(found.norm(), 0) << response.parameters[p].name;
                EXPECT_EQ(slope.norm(), 0) << response.parameters[p].name;
            } else {
                EXPECT_LT((found - slope).norm(), 1e-5 * slope.norm()) << response.parameters[p].name;
                EXPECT_GT(slope.norm(), 0) << response.parameters[p].name;
            }
        }
    }
}

TEST(FrequencySprings, DerivativesAtTheEndsOfTheRange) {
    const SpringNetwork sample;
    ContactModel model = adhesive();
    model.normal_viscosity = 1e-3;
    for (const double poisson : {0.0, 0.5}) {
        model.poisson_ratio = poisson;
        model.prestress = 0;
        const auto response = solve_frequency_sweep(sample.packing, sample.bonds, model, std::array{10.0});
        for (std::size_t p = 0; p < response.parameters.size(); ++p) {
            if (response.parameters[p].name != "poisson_ratio") {
                continue;
            }
            const double step = poisson == 0 ? 1e-4 : -1e-4;
            const auto at = [&](double change) {
                ContactModel changed = model;
                changed.poisson_ratio += change;
                return sample.at(10.0, changed).modulus;
            };
            const ComplexTensor slope = (4.0 * at(step) - 3.0 * at(0) - at(2 * step)) / (2 * step);
            EXPECT_LT((response.points[0].derivative[p] - slope).norm(), 1e-5 * slope.norm()) << poisson;
        }
    }
}

TEST(FrequencySprings, LossesAreWhatBondsFilmsAndParticlesDissipate) {
    const SpringNetwork sample;
    for (const ContactModel& model : {lubricated(with_moments()), lubricated(adhesive())}) {
        for (const double frequency : {10.0, 1e4}) {
            const FrequencyPoint point = sample.at(frequency, model);
            for (int strain = 0; strain < 6; ++strain) {
                const double loss = std::numbers::pi * point.modulus(strain, strain).imag();
                EXPECT_GT(loss, 0);
                EXPECT_NEAR(point.dissipation[strain], loss, 1e-5 * loss) << frequency << " Hz, strain " << strain;
            }
        }
    }
}

/// Two unequal particles with a gap between them, along x.
struct SpringPair {
    Packing packing;
    ContactModel model;
    double viscosity = 1e-3;

    explicit SpringPair(double gap) {
        packing.cell = Cell::periodic({3e-6, 4e-6, 5e-6});
        packing.radii.resize(2);
        packing.radii << 0.25e-6, 0.4e-6;
        packing.positions.resize(3, 2);
        packing.positions << 1e-6, 1e-6 + packing.radii.sum() + gap, 1e-6, 1e-6, 1e-6, 1e-6;
        model.solvent_viscosity = viscosity;
        model.lubrication_gap = 1e-9;
        model.lubrication_cutoff = 5e-8;
    }
    double distance() const { return packing.positions(0, 1) - packing.positions(0, 0); }
    /// Modulus of a link of this stiffness in series with the drag on both particles.
    Complex in_series(const Complex& link, double w) const {
        const auto drag = [&](Index i) { return Complex(0, w * viscosity * translation_drag(packing.radii[i])); };
        return distance() * distance() / packing.cell.volume() / (1.0 / link + 1.0 / drag(0) + 1.0 / drag(1));
    }
    FrequencyPoint at(double w, const ContactNetwork& bonds) const {
        return solve_frequency_sweep(packing, bonds, model, std::array{w / full_turn}).points.at(0);
    }
};

TEST(FrequencyFilms, PairInClosedForm) {
    const double radius = 0.25e-6 * 0.4e-6 / 0.65e-6;
    for (const double gap : {2e-8, 3e-9, 0.2e-9, -1e-9}) {
        const SpringPair pair(gap);
        const double film = 6 * std::numbers::pi * 1e-3 * radius * radius / std::max(gap, 1e-9);
        const ContactNetwork none = bonds_between(pair.packing, {});
        const ContactNetwork bond = bonds_between(pair.packing, {{1, 0}});
        for (const double w : {1e3, 1e9}) {
            const Complex alone = pair.in_series(Complex(0, w * film), w);
            EXPECT_LT(std::abs(pair.at(w, none).modulus(0, 0) - alone), 1e-9 * std::abs(alone)) << gap;
            const Complex bonded = pair.in_series(Complex(50, w * film), w);
            EXPECT_LT(std::abs(pair.at(w, bond).modulus(0, 0) - bonded), 1e-9 * std::abs(bonded)) << gap;
        }
    }
    const SpringPair apart(6e-8);
    EXPECT_EQ(apart.at(1e3, bonds_between(apart.packing, {})).modulus.norm(), 0);
}

TEST(FrequencyFilms, AreOfAllNearPairsOnce) {
    const SpringNetwork sample;
    const ContactModel model = lubricated({});
    const FrequencyPairs pairs = find_frequency_pairs(sample.packing, sample.bonds, model);
    Index near = 0;
    for (Index i = 0; i < sample.packing.size(); ++i) {
        for (Index j = i + 1; j < sample.packing.size(); ++j) {
            const double distance =
                sample.packing.cell.minimum_image(sample.packing.positions.col(j) - sample.packing.positions.col(i)).norm();
            near += distance - sample.packing.radii[i] - sample.packing.radii[j] < model.lubrication_cutoff ? 1 : 0;
        }
    }
    EXPECT_EQ(pairs.network.size(), near);  // all bonds are nearer
    EXPECT_GT(near, sample.bonds.size());
    Index films = 0;
    for (const double film : pairs.film) {
        films += film > 0 ? 1 : 0;
    }
    EXPECT_EQ(films, near);
}

TEST(FrequencySprings, SameBitsForOneAndTwoThreads) {
    const SpringNetwork sample;
    omp_set_num_threads(1);
    const FrequencyPoint one = sample.at(100.0, lubricated(adhesive()));
    omp_set_num_threads(2);
    const FrequencyPoint two = sample.at(100.0, lubricated(adhesive()));
    EXPECT_TRUE(one.modulus == two.modulus);
    EXPECT_TRUE(one.derivative.back() == two.derivative.back());
}

TEST(FrequencySprings, RefusesUnstableAndStifflessBonds) {
    const SpringNetwork sample;
    ContactModel model;
    model.shear_stiffness = 0;
    model.prestress = 1e-6;
    EXPECT_THROW(sample.at(1.0, model), std::runtime_error);
    model = adhesive();
    model.work_of_adhesion = model.prestress = unset;
    EXPECT_THROW(sample.at(1.0, model), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
