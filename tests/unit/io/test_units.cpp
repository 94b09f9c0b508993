// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/units.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <thread>
#include <vector>

namespace coagula::io {
namespace {

TEST(Units, ReadsNumbersWithUnits) {
    EXPECT_EQ(parse_quantity("0.25um", "m"), 2.5e-7);
    EXPECT_EQ(parse_quantity("0.25 um", "m"), 2.5e-7);
    EXPECT_EQ(parse_quantity("  0.3 µm ", "m"), 3e-7);
    EXPECT_EQ(parse_quantity("0.3 μm", "m"), 3e-7);
    EXPECT_EQ(parse_quantity("10.94um", "m"), 10.94e-6);
    EXPECT_EQ(parse_quantity("2.5e-7", "m"), 2.5e-7);
    EXPECT_EQ(parse_quantity("1e-7m", "m"), 1e-7);
    EXPECT_EQ(parse_quantity("+3 nm", "m"), 3e-9);
    EXPECT_EQ(parse_quantity("-15mV", "V"), -0.015);
    EXPECT_EQ(parse_quantity("100N/m", "N/m"), 100);
    EXPECT_EQ(parse_quantity("100 N m-1", "N/m"), 100);
    EXPECT_EQ(parse_quantity("100 mN/m", "N/m"), 0.1);
    EXPECT_EQ(parse_quantity("3.69 g/cm3", "kg/m3"), 3690);
    EXPECT_EQ(parse_quantity("1 1/s", "Hz"), 1);
    EXPECT_EQ(parse_quantity("2kHz", "Hz"), 2000);
    EXPECT_DOUBLE_EQ(parse_quantity("20 degC", "K"), 293.15);
    EXPECT_EQ(parse_quantity("4 MPa", "Pa"), 4e6);
    EXPECT_EQ(parse_quantity("7", "1"), 7);
    EXPECT_EQ(parse_quantity("12 %", "1"), 0.12);
    for (const char* text : {"180 degrees", "180 deg", "180deg", "180 °", "180°"}) {
        EXPECT_DOUBLE_EQ(parse_quantity(text, "rad"), 3.14159265358979323846) << text;
    }
}

TEST(Units, KnowsTheMolarWhereAConcentrationIsAsked) {
    EXPECT_EQ(parse_quantity("10 mM", "mol/m3"), 10);
    EXPECT_EQ(parse_quantity("0.01M", "mol/m3"), 10);
    EXPECT_DOUBLE_EQ(parse_quantity("250 uM", "mol/m3"), 0.25);
    EXPECT_EQ(parse_quantity("10 mmol/l", "mol/m3"), 10);
    EXPECT_THROW(parse_quantity("10 mM", "m"), InputError);
    EXPECT_THROW(parse_quantity("10 kgM", "mol/m3"), InputError);
}

TEST(Units, ConvertsColumnsWithTheirZero) {
    const std::vector<double> kelvin = convert({0, 25, std::nan("")}, "°C", "K");
    EXPECT_DOUBLE_EQ(kelvin[0], 273.15);
    EXPECT_DOUBLE_EQ(kelvin[1], 298.15);
    EXPECT_TRUE(std::isnan(kelvin[2]));
    EXPECT_EQ(convert({3}, "mN·m", "N.m")[0], 3e-3);
    EXPECT_EQ(convert({12}, "%", "1")[0], 0.12);
    EXPECT_THROW(convert({1}, "Pa", "m"), InputError);
    EXPECT_THROW(convert({1}, "", "m"), InputError);
}

TEST(Units, TellsMillisecondsFromMetreSeconds) {
    EXPECT_EQ(parse_quantity("5ms", "s"), 0.005);
    EXPECT_EQ(parse_quantity("5 m s", "m s"), 5);
    EXPECT_THROW(parse_quantity("5 m s", "s"), InputError);
    EXPECT_THROW(parse_quantity("5ms", "m s"), InputError);
}

std::string sentence_of(const std::string& text, const std::string& unit) {
    try {
        parse_quantity(text, unit);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error for '" + text + "'";
}

TEST(Units, RejectsWithTheTextAndTheExpectedUnit) {
    for (const std::string text :
         {"",         " ",         "um",        "0.25 um um", "0.25 um 7", "0.25 3um", "0.25um@3", "0.25 V",  "0.25m-1",
          "0,25um",   "nan",       "inf m",     "0.25umm",    "1e400",     "1e999m",   "0x10",     "--1",     "+-1",
          "0.25 um;", "0.25 m--1", "0.25 m+-2", "0.25 1",     "3 m 1",     "0.25 (",   "1..5um",   "1e308 km"}) {
        const std::string sentence = sentence_of(text, "m");
        EXPECT_TRUE(sentence.starts_with("'" + text + "' is not a quantity in m: ")) << sentence;
    }
}

TEST(Units, RefusesWhatUdunitsTakesInPart) {
    const std::string nul = std::string("1 m") + '\0' + "garbage";
    for (const std::string& text : {nul, std::string(3, '\0')}) {
        EXPECT_EQ(sentence_of(text, "m"), "a text with a NUL character is not a quantity or unit (expected: one in m)");
    }
    EXPECT_THROW(unit_factor(nul.substr(2), "m"), InputError);
    EXPECT_THROW(convert({1}, nul.substr(2), "m"), InputError);
}

TEST(Units, RefusesWhatIsTooLongForAUnit) {
    // The checks below it take the square of the length: seven minutes for this one.
    EXPECT_EQ(sentence_of("1 m" + std::string(500000, '9'), "m"),
              "a text of 500001 characters is not a unit (expected: a unit such as m)");
}

TEST(Units, RefusesUnitsAndNumbersBeyondTheRange) {
    EXPECT_EQ(sentence_of("1 Ym20", "m20"), "'1 Ym20' is not a quantity in m20: 'Ym20' is too large or too small a unit for m20");
    EXPECT_THROW(unit_factor("Ym20", "m20"), InputError);
    EXPECT_THROW(unit_factor("ym20", "m20"), InputError);
    EXPECT_EQ(convert({1, 2}, "km", "m"), (std::vector<double>{1000, 2000}));
    EXPECT_THROW(convert({1, 1e307}, "km", "m"), InputError);
}

TEST(Units, ReciprocalsAndAnglesAreOtherDimensions) {
    EXPECT_THROW(parse_quantity("5 Hz", "s"), InputError);
    EXPECT_THROW(parse_quantity("5 rad/s", "Hz"), InputError);
    EXPECT_THROW(parse_quantity("5 s since 2000-01-01", "s"), InputError);
    EXPECT_THROW(parse_quantity("5 rad", "1"), InputError);
}

TEST(Units, FactorsBetweenUnits) {
    EXPECT_EQ(unit_factor("um", "m"), 1e-6);
    EXPECT_EQ(unit_factor(" micrometer ", "m"), 1e-6);
    EXPECT_EQ(unit_factor("nm", "m"), 1e-9);
    EXPECT_EQ(unit_factor("km", "m"), 1000);
    EXPECT_THROW(unit_factor("px", "m"), InputError);
    EXPECT_THROW(unit_factor("degC", "K"), InputError);
    EXPECT_THROW(unit_factor("", "m"), InputError);
}

TEST(Units, IsSafeForThreads) {
    std::vector<std::thread> threads;
    std::vector<double> sums(4, 0.0);
    for (double& sum : sums) {
        threads.emplace_back([&sum] {
            for (int i = 0; i < 500; ++i) {
                sum += parse_quantity("1 km", "m");
            }
        });
    }
    for (auto& thread : threads) {
        thread.join();
    }
    EXPECT_EQ(sums, std::vector<double>(4, 500000.0));
}

}  // namespace
}  // namespace coagula::io
