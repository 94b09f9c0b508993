// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/contact_model.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace coagula {
namespace {

using Complex = std::complex<double>;

/// Every term at once.
ContactModel full_model() {
    ContactModel model;
    model.normal_viscosity = 0.02;
    model.shear_viscosity = 0.003;
    model.normal_maxwell_stiffness = 30;
    model.normal_maxwell_time = 0.01;
    model.shear_maxwell_stiffness = 4;
    model.shear_maxwell_time = 0.05;
    model.normal_springpot_stiffness = 20;
    model.normal_springpot_time = 0.3;
    model.normal_springpot_exponent = 0.4;
    model.shear_springpot_stiffness = 2;
    model.shear_springpot_time = 0.002;
    model.shear_springpot_exponent = 0.7;
    model.solvent_viscosity = 1e-3;
    model.lubrication_gap = 1e-9;
    model.lubrication_cutoff = 2e-8;
    model.bending_stiffness = 3e-13;
    model.twisting_stiffness = 2e-13;
    model.young_modulus = 70e9;
    model.poisson_ratio = 0.3;
    model.work_of_adhesion = 0.5;
    model.normal_strength = 1e-7;
    model.shear_strength = 1e-8;
    model.bending_strength = 1e-15;
    model.friction = 0.3;
    model.prestress = 1e-9;
    model.ageing_rate = 0.1;
    model.ageing_time = 5;
    return model;
}

TEST(ContactModel, SpringsAloneAreRealAndTwoInSeries) {
    const ContactStiffness k = complex_stiffness({}, 123.0);
    EXPECT_EQ(k.normal, Complex(50, 0));
    EXPECT_EQ(k.shear, Complex(5, 0));
}

TEST(ContactModel, EachElementInItsLimits) {
    ContactModel model;
    model.normal_viscosity = 0.5;
    EXPECT_EQ(complex_stiffness(model, 4.0).normal, Complex(50, 2));

    model = {};
    model.shear_maxwell_stiffness = 3;
    model.shear_maxwell_time = 0.1;
    EXPECT_NEAR(complex_stiffness(model, 1e-6).shear.imag(), 3e-7, 1e-15);                      // a dashpot k t
    EXPECT_NEAR(std::abs(complex_stiffness(model, 1e9).shear - 8.0), 0, 1e-7);                  // a spring
    EXPECT_NEAR(std::abs(complex_stiffness(model, 10.0).shear - Complex(6.5, 1.5)), 0, 1e-14);  // the peak of the loss at w t = 1

    model = {};
    model.normal_springpot_stiffness = 7;
    model.normal_springpot_time = 0.1;
    model.normal_springpot_exponent = 0;
    EXPECT_NEAR(std::abs(complex_stiffness(model, 3.0).normal - 57.0), 0, 1e-13);
    model.normal_springpot_exponent = 1;
    EXPECT_NEAR(std::abs(complex_stiffness(model, 3.0).normal - Complex(50, 2.1)), 0, 1e-13);
    model.normal_springpot_exponent = 0.5;
    const double part = 7 * std::sqrt(0.5 * 0.3);  // sqrt(i x) = (1 + i) sqrt(x / 2)
    EXPECT_NEAR(std::abs(complex_stiffness(model, 3.0).normal - Complex(50 + part, part)), 0, 1e-13);
}

TEST(ContactModel, PassiveAtEveryFrequency) {
    for (double w = 1e-3; w < 1e6; w *= 10) {
        const ContactStiffness k = complex_stiffness(full_model(), w);
        EXPECT_GT(k.normal.real(), 50);
        EXPECT_GT(k.normal.imag(), 0);
        EXPECT_GT(k.shear.real(), 5);
        EXPECT_GT(k.shear.imag(), 0);
    }
}

TEST(ContactModel, DerivativesAreThoseOfTheStiffness) {
    const ContactModel model = full_model();
    for (const double w : {0.3, 11.0, 5e3}) {
        for (const ContactParameter& parameter : contact_parameters()) {
            ContactModel more = model;
            ContactModel less = model;
            const double step = 1e-5 * model.*parameter.value;
            more.*parameter.value += step;
            less.*parameter.value -= step;
            const ContactStiffness high = complex_stiffness(more, w);
            const ContactStiffness low = complex_stiffness(less, w);
            const ContactStiffness slope = stiffness_derivative(model, w, parameter.value);
            const double noise = 1e-14 * (std::abs(high.normal) + std::abs(high.shear)) / step;
            EXPECT_NEAR(std::abs((high.normal - low.normal) / (2 * step) - slope.normal), 0, 1e-8 * std::abs(slope.normal) + noise)
                << parameter.name;
            EXPECT_NEAR(std::abs((high.shear - low.shear) / (2 * step) - slope.shear), 0, 1e-8 * std::abs(slope.shear) + noise)
                << parameter.name;
        }
    }
}

TEST(ContactModel, DragOfTheParticleOfThePaper) {
    EXPECT_NEAR(1e-3 * translation_drag(0.25e-6), 4.712e-9, 1e-12);
    EXPECT_DOUBLE_EQ(rotation_drag(2.0), 64 * std::numbers::pi);
}

TEST(ContactModel, EveryParameterIsListedOnceWithUnitMeaningAndSource) {
    ContactModel model = full_model();
    for (const ContactParameter& parameter : contact_parameters()) {
        EXPECT_TRUE(parameter.is_set(model)) << parameter.name;
        EXPECT_FALSE(parameter.unit.empty() || parameter.meaning.empty() || parameter.source.empty()) << parameter.name;
        model.*parameter.value = unset;
    }
    EXPECT_EQ(contact_parameters().size(), sizeof(ContactModel) / sizeof(double));
}

void expect_refused(const ContactModel& model, const std::string& part) {
    try {
        check(model);
        FAIL() << "not refused: " << part;
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(ContactModel, RefusesValuesOutOfRange) {
    EXPECT_NO_THROW(check(full_model()));
    EXPECT_NO_THROW(check(ContactModel{}));
    for (const ContactParameter& parameter : contact_parameters()) {
        ContactModel model = full_model();
        if (std::isfinite(parameter.low)) {
            model.*parameter.value = -1;
            expect_refused(model, parameter.name + " of the contact model is -1");
        }
        model.*parameter.value = std::numeric_limits<double>::infinity();
        expect_refused(model, parameter.name);
    }
    ContactModel model = full_model();
    model.normal_springpot_exponent = 1.5;
    expect_refused(model, "0 .. 1");
    model = full_model();
    model.poisson_ratio = 0.6;
    expect_refused(model, "0 .. 0.5");
}

TEST(ContactModel, RefusesPartsWithoutWhatTheyNeed) {
    struct Missing {
        double ContactModel::*parameter;
        const char* part;
    };
    const std::vector<Missing> all = {{&ContactModel::normal_stiffness, "needs normal_stiffness"},
                                      {&ContactModel::shear_maxwell_time, "shear_maxwell_stiffness but no shear_maxwell_time"},
                                      {&ContactModel::normal_springpot_exponent, "but no normal_springpot_exponent"},
                                      {&ContactModel::poisson_ratio, "young_modulus but no poisson_ratio"},
                                      {&ContactModel::ageing_rate, "ageing_time but no ageing_rate"},
                                      {&ContactModel::lubrication_cutoff, "lubrication_gap but no lubrication_cutoff"},
                                      {&ContactModel::solvent_viscosity, "lubrication_gap but no solvent_viscosity"}};
    for (const Missing& missing : all) {
        ContactModel model = full_model();
        model.*missing.parameter = unset;
        expect_refused(model, missing.part);
    }
    expect_refused({.work_of_adhesion = 1}, "work_of_adhesion but no young_modulus");
    ContactModel model = full_model();
    model.lubrication_gap = 3e-8;
    expect_refused(model, "3e-08 m: it must not be larger than lubrication_cutoff");
}

TEST(ContactModel, RefusesStrengthsThatNothingReaches) {
    expect_refused({.shear_stiffness = 0, .shear_strength = 1e-6}, "shear_strength, but its shear_stiffness is 0");
    expect_refused({.bending_strength = 1e-15}, "neither bending_stiffness nor twisting_stiffness");
    expect_refused({.bending_stiffness = 0, .bending_strength = 1e-15}, "neither bending_stiffness nor twisting_stiffness");
    EXPECT_NO_THROW(check({.twisting_stiffness = 1e-13, .bending_strength = 1e-15}));
    expect_refused({.normal_strength = 1e-6, .prestress = -2e-6}, "a bond breaks at a tension of 1e-06 N");
    EXPECT_NO_THROW(check({.normal_strength = 1e-6, .prestress = 2e-6}));
}

}  // namespace
}  // namespace coagula
