#include <coagula/common/contact_model.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

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

TEST(ContactModel, RefusesWhatCannotBe) {
    EXPECT_NO_THROW(check(full_model()));
    for (const ContactParameter& parameter : contact_parameters()) {
        ContactModel model = full_model();
        model.*parameter.value = -1;
        expect_refused(model, parameter.name + " of the contact model is -1");
        model.*parameter.value = std::numeric_limits<double>::infinity();
        expect_refused(model, parameter.name);
    }
    ContactModel model;
    model.normal_stiffness = unset;
    expect_refused(model, "needs normal_stiffness");
    model = {};
    model.shear_maxwell_stiffness = 1;
    expect_refused(model, "no shear_maxwell_time");
    model = full_model();
    model.normal_springpot_exponent = unset;
    expect_refused(model, "no normal_springpot_exponent");
    model.normal_springpot_exponent = 1.5;
    expect_refused(model, "0 .. 1");
}

}  // namespace
}  // namespace coagula
