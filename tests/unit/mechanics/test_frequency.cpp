// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include "networks.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <cmath>
#include <numbers>

namespace coagula::mechanics {
namespace {

using coagula::testing::bonds_between;
using coagula::testing::random_spheres;
using Complex = std::complex<double>;

constexpr double two_pi = 2 * std::numbers::pi;

/// Rattlers, spins and floppy modes included.
struct DampedNetwork {
    Packing packing = random_spheres(120, 10.0, 0.25e-6, 21);
    ContactNetwork bonds = find_contacts(packing, 0.02);

    FrequencyPoint at(double frequency, const ContactModel& model, const FrequencyOptions& options = {}) const {
        return solve_frequency_sweep(packing, bonds, model, std::array{frequency}, options).points.at(0);
    }
};

/// Every loss of the contact; not the solvent.
ContactModel lossy_model() {
    ContactModel model;
    model.normal_viscosity = 0.02;
    model.shear_viscosity = 0.004;
    model.normal_maxwell_stiffness = 30;
    model.normal_maxwell_time = 0.01;
    model.shear_maxwell_stiffness = 4;
    model.shear_maxwell_time = 0.05;
    model.normal_springpot_stiffness = 20;
    model.normal_springpot_time = 0.03;
    model.normal_springpot_exponent = 0.4;
    model.shear_springpot_stiffness = 2;
    model.shear_springpot_time = 0.02;
    model.shear_springpot_exponent = 0.7;
    return model;
}

ContactModel suspended(ContactModel model) {
    model.solvent_viscosity = 1e-3;
    return model;
}

TEST(Frequency, WithoutLossesItIsTheLinearResponse) {
    const DampedNetwork sample;
    const auto linear = solve_linear(sample.packing, sample.bonds);
    const FrequencyPoint point = sample.at(10.0, {});
    const Eigen::Matrix<double, 6, 6> real = point.modulus.real();
    ASSERT_GT(linear.mean_shear_modulus(), 0);
    EXPECT_LT((real - linear.elastic_tensor).norm(), 1e-9 * real.norm());
    EXPECT_EQ(point.modulus.imag().cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(point.dissipation.norm(), 0);
}

TEST(Frequency, DoesNotDependOnTheShift) {
    const DampedNetwork sample;
    for (const ContactModel& model : {lossy_model(), suspended(lossy_model())}) {
        const FrequencyPoint reference = sample.at(10.0, model);
        for (const double shift : {1e-7, 1e-9, 1e-12}) {
            const FrequencyPoint other = sample.at(10.0, model, {.shift = shift});
            EXPECT_LT((other.modulus - reference.modulus).norm(), 1e-8 * reference.modulus.norm()) << shift;
        }
    }
}

/// A row of unequal spheres that closes over the boundary, box 1 um x 1 um across.
Packing row_of_spheres() {
    Packing packing;
    packing.radii.resize(4);
    packing.radii << 0.1e-6, 0.25e-6, 0.15e-6, 0.2e-6;
    packing.positions = Eigen::Matrix3Xd::Constant(3, 4, 0.5e-6);
    double x = 0;
    for (int i = 0; i < 4; ++i) {
        packing.positions(0, i) = x + packing.radii[i];
        x += 2 * packing.radii[i];
    }
    packing.cell = Cell::periodic({x, 1e-6, 1e-6});
    return packing;
}

// Four equal contacts in series: each takes a quarter of the stretch.
TEST(Frequency, ChainOfUnequalSpheresInClosedForm) {
    const Packing packing = row_of_spheres();
    const double length = packing.cell.lengths()[0];
    const std::array<double, 4> frequencies{0.1, 3.0, 40.0, 1e4};
    ContactModel dashpot;
    dashpot.normal_viscosity = 0.3;
    ContactModel maxwell;
    maxwell.normal_maxwell_stiffness = 25;
    maxwell.normal_maxwell_time = 0.01;
    ContactModel springpot;
    springpot.normal_springpot_stiffness = 40;
    springpot.normal_springpot_time = 0.2;
    springpot.normal_springpot_exponent = 0.3;
    const std::array<Complex (*)(double), 3> stiffness{[](double w) { return Complex(50, 0.3 * w); },
                                                       [](double w) { return 50.0 + 25.0 / (1.0 + 1.0 / Complex(0, 0.01 * w)); },
                                                       [](double w) { return 50.0 + 40.0 * std::pow(Complex(0, 0.2 * w), 0.3); }};
    std::size_t element = 0;
    for (const ContactModel& model : {dashpot, maxwell, springpot}) {
        const auto response = solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, frequencies);
        ASSERT_EQ(response.contacts, 4);
        for (const FrequencyPoint& point : response.points) {
            const Complex expected =
                stiffness.at(element)(two_pi * point.frequency) / 4.0 * length * length / packing.cell.volume();
            EXPECT_LT(std::abs(point.modulus(0, 0) - expected), 1e-10 * std::abs(expected)) << element << ", " << point.frequency;
        }
        ++element;
    }
}

/// One bond along x in a solvent, seen as springs and drags in series.
struct DampedPair {
    double radius = 0.25e-6;
    double distance = 2 * radius;
    double viscosity = 1e-3;
    Complex normal_drag;  ///< i w times drag, between the two centres
    ContactModel model;
    Packing packing;

    explicit DampedPair(double w) : normal_drag(0, w * viscosity * translation_drag(radius)) {
        model.normal_viscosity = 2e-9;
        model.solvent_viscosity = viscosity;
        packing.cell = Cell::periodic({3e-6, 4e-6, 5e-6});
        packing.radii = Eigen::VectorXd::Constant(2, radius);
        packing.positions.resize(3, 2);
        packing.positions << 1e-6, 1e-6 + distance, 1e-6, 1e-6, 1e-6, 1e-6;
    }
};

TEST(Frequency, TwoParticlesInASolventInClosedForm) {
    for (const double w : {1e8, 1e10, 3e12}) {
        const DampedPair pair(w);
        const FrequencyPoint point =
            solve_frequency_sweep(pair.packing, bonds_between(pair.packing, {{0, 1}}), pair.model, std::array{w / two_pi})
                .points.at(0);
        const double per_volume = pair.distance * pair.distance / pair.packing.cell.volume();
        // The bond in series with the drag of both ends.
        const Complex k = Complex(50, 2e-9 * w);
        const Complex stretched = 1.0 / (1.0 / k + 2.0 / pair.normal_drag);
        EXPECT_LT(std::abs(point.modulus(0, 0) - per_volume * stretched), 1e-9 * per_volume * std::abs(stretched)) << w;
        // Across the bond it also turns the spheres: lever r, force f, torque r f against i w 8 pi eta r^3.
        const Complex turn(0, w * pair.viscosity * rotation_drag(pair.radius) / (pair.radius * pair.radius));
        const Complex sheared = 0.25 / (1.0 / 5.0 + 2.0 / pair.normal_drag + 2.0 / turn);
        EXPECT_LT(std::abs(point.modulus(5, 5) - per_volume * sheared), 1e-9 * per_volume * std::abs(sheared)) << w;
        EXPECT_LT(std::abs(point.modulus(4, 4) - per_volume * sheared), 1e-9 * per_volume * std::abs(sheared)) << w;
        EXPECT_LT(std::abs(point.modulus(1, 1)), 1e-12 * per_volume * std::abs(stretched));
    }
}

TEST(Frequency, DerivativesAgreeWithFiniteDifferences) {
    const DampedNetwork sample;
    const ContactModel model = suspended(lossy_model());
    const double frequency = 30.0;
    const auto response = solve_frequency_sweep(sample.packing, sample.bonds, model, std::array{frequency});
    ASSERT_EQ(response.parameters.size(), 15U);  // two springs, twelve losses, the solvent
    for (std::size_t p = 0; p < response.parameters.size(); ++p) {
        const auto member = response.parameters[p].value;
        const double step = 3e-4 * model.*member;
        ContactModel more = model;
        ContactModel less = model;
        more.*member += step;
        less.*member -= step;
        const ComplexTensor slope = (sample.at(frequency, more).modulus - sample.at(frequency, less).modulus) / (2 * step);
        const ComplexTensor& found = response.points[0].derivative[p];
        EXPECT_LT((found - slope).norm(), 1e-5 * slope.norm()) << response.parameters[p].name;
        EXPECT_GT(slope.norm(), 0) << response.parameters[p].name;
    }
}

TEST(Frequency, DerivativeByTheSolventWhereDragAndBondsAreAlike) {
    const DampedNetwork sample;
    ContactModel model = suspended(lossy_model());
    model.solvent_viscosity = 1e3;  // i w zeta is about the contact stiffness
    const double frequency = 1e4;
    const auto response = solve_frequency_sweep(sample.packing, sample.bonds, model, std::array{frequency});
    ContactModel more = model;
    ContactModel less = model;
    more.solvent_viscosity *= 1.0003;
    less.solvent_viscosity *= 0.9997;
    const ComplexTensor slope =
        (sample.at(frequency, more).modulus - sample.at(frequency, less).modulus) / (2 * 0.0003 * model.solvent_viscosity);
    ASSERT_EQ(response.parameters.back().name, "solvent_viscosity");
    EXPECT_LT((response.points[0].derivative.back() - slope).norm(), 1e-5 * slope.norm());
}

TEST(Frequency, LossesAreWhatBondsAndParticlesDissipate) {
    const DampedNetwork sample;
    ContactModel viscous = suspended(lossy_model());
    viscous.solvent_viscosity = 1e3;
    for (const ContactModel& model : {lossy_model(), suspended({}), viscous}) {
        for (const double frequency : {0.1, 100.0, 1e4}) {
            const FrequencyPoint point = sample.at(frequency, model);
            for (int strain = 0; strain < 6; ++strain) {
                const double loss = std::numbers::pi * point.modulus(strain, strain).imag();
                EXPECT_GT(loss, 0);
                EXPECT_NEAR(point.dissipation[strain], loss, 1e-5 * loss) << frequency << " Hz, strain " << strain;
            }
        }
    }
}

TEST(Frequency, LossOfDashpotsAndDragIsProportionalToTheFrequency) {
    const DampedNetwork sample;
    ContactModel dashpots;
    dashpots.normal_viscosity = 1e-4;
    dashpots.shear_viscosity = 1e-5;
    // The solvent slows soft modes of the network already at some hertz.
    for (const ContactModel& model : {dashpots, suspended({})}) {
        const auto response = solve_frequency_sweep(sample.packing, sample.bonds, model, std::array{1e-3, 2e-3, 8e-3});
        const double storage = response.points[0].mean_shear_modulus().real();
        const double loss_rate = response.points[0].mean_shear_modulus().imag() / response.points[0].frequency;
        for (const FrequencyPoint& point : response.points) {
            EXPECT_NEAR(point.mean_shear_modulus().imag() / point.frequency, loss_rate, 1e-6 * loss_rate);
            EXPECT_NEAR(point.mean_shear_modulus().real(), storage, 1e-6 * storage);
        }
    }
}

// The same network relaxes all bonds alike when every k* has the same phase: G* = G' (k* / k).
TEST(Frequency, EqualLossFactorsGiveTheNetworkThatFactor) {
    const DampedNetwork sample;
    ContactModel model;
    model.normal_viscosity = 0.05;
    model.shear_viscosity = 0.005;
    const double elastic = solve_linear(sample.packing, sample.bonds).mean_shear_modulus();
    const Complex found = sample.at(200.0, model).mean_shear_modulus();
    EXPECT_LT(std::abs(found - elastic * Complex(1, two_pi * 200.0 * 0.05 / 50)), 1e-8 * std::abs(found));
}

TEST(Frequency, TensorIsSymmetricAndOrientationsArePartsOfIt) {
    const DampedNetwork sample;
    const FrequencyPoint point = sample.at(30.0, suspended(lossy_model()));
    EXPECT_LT((point.modulus - point.modulus.transpose()).norm(), 1e-14 * point.modulus.norm());
    EXPECT_EQ(point.shear_modulus(0, 1), point.modulus(5, 5));
    EXPECT_EQ(point.shear_modulus(2, 0), point.modulus(4, 4));
    EXPECT_EQ(point.shear_modulus(1, 2), point.modulus(3, 3));
    EXPECT_THROW(point.shear_modulus(1, 1), std::invalid_argument);
    EXPECT_LT(point.residual, 2e-10);
}

TEST(Frequency, SameBitsForOneAndTwoThreads) {
    const Packing packing = random_spheres(700, 17.0, 0.25e-6, 4);
    const auto bonds = find_contacts(packing, 0.05);
    for (const ContactModel& model : {lossy_model(), suspended(lossy_model())}) {
        omp_set_num_threads(1);
        const auto one = solve_frequency_sweep(packing, bonds, model, std::array{1.0, 1e3});
        omp_set_num_threads(2);
        const auto two = solve_frequency_sweep(packing, bonds, model, std::array{1.0, 1e3});
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_TRUE(one.points[k].modulus == two.points[k].modulus);
            EXPECT_TRUE(one.points[k].derivative.back() == two.points[k].derivative.back());
            EXPECT_TRUE(one.points[k].dissipation == two.points[k].dissipation);
        }
    }
}

// In a sweep, a frequency may be solved with the factor of the one before.
TEST(Frequency, SweepAgreesWithSingleFrequencies) {
    const DampedNetwork sample;
    const std::array<double, 6> frequencies{1.0, 1.6, 2.5, 4.0, 400.0, 500.0};
    for (const ContactModel& model : {lossy_model(), suspended(lossy_model()), suspended({})}) {
        const auto sweep = solve_frequency_sweep(sample.packing, sample.bonds, model, frequencies);
        for (const FrequencyPoint& point : sweep.points) {
            const FrequencyPoint alone = sample.at(point.frequency, model);
            EXPECT_LT((point.modulus - alone.modulus).norm(), 1e-10 * alone.modulus.norm());
            for (std::size_t p = 0; p < sweep.parameters.size(); ++p) {
                EXPECT_LT((point.derivative[p] - alone.derivative[p]).norm(), 1e-6 * alone.derivative[p].norm());
            }
        }
    }
}

TEST(Frequency, ExtremeFrequenciesGiveTheLimits) {
    const DampedNetwork sample;
    const double elastic = solve_linear(sample.packing, sample.bonds).mean_shear_modulus();
    const Complex slow = sample.at(1e-300, suspended({})).mean_shear_modulus();
    EXPECT_NEAR(slow.real(), elastic, 1e-7 * elastic);
    EXPECT_LT(slow.imag(), 1e-200);
    ContactModel frictionless = suspended({});
    frictionless.shear_stiffness = 0;
    EXPECT_TRUE(sample.at(1.0, frictionless).modulus.allFinite());
    frictionless.solvent_viscosity = unset;
    EXPECT_TRUE(sample.at(1.0, frictionless).modulus.allFinite());
}

TEST(Frequency, NetworkThatCarriesNothingHasModulusZero) {
    const Packing packing = random_spheres(10, 40.0, 0.25e-6, 2);
    for (const ContactModel& model : {lossy_model(), suspended(lossy_model())}) {
        const auto response = solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, std::array{10.0});
        EXPECT_EQ(response.rattlers, 10);
        EXPECT_TRUE(response.points.at(0).modulus.isZero(0));
    }
}

TEST(Frequency, RefusesImpossibleInput) {
    const DampedNetwork sample;
    EXPECT_THROW(sample.at(0.0, {}), std::invalid_argument);
    EXPECT_THROW(sample.at(-1.0, {}), std::invalid_argument);
    ContactModel model;
    model.normal_viscosity = -1;
    EXPECT_THROW(sample.at(1.0, model), std::invalid_argument);
    EXPECT_THROW(sample.at(1.0, {}, {.tolerance = 0}), std::invalid_argument);
    EXPECT_THROW(sample.at(1e300, lossy_model()), std::invalid_argument);
    DampedNetwork open;
    open.packing.cell = Cell::open(Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(10e-6));
    EXPECT_THROW(open.at(1.0, {}), std::invalid_argument);
}

}  // namespace
}  // namespace coagula::mechanics
