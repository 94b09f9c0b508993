// SPDX-License-Identifier: GPL-3.0-or-later
// Misfits, remainders and proposals are written as sentences.
#include "finding_sentences.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace coagula::report {
namespace {

using diagnose::Misfit;
using diagnose::SmoothMisfit;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

TEST(FindingSentences, ADepartureThatChangesHasTwoSizesAndAPlace) {
    EXPECT_EQ(sentence_on(Misfit{"storage_modulus", "strain", 5, 0.02, -0.3, SmoothMisfit{.before = -0.015}}),
              "G' falls relative to the base model along strain: mean difference -1.5 % before and -30 % from 2 % on");
    EXPECT_EQ(sentence_on(Misfit{"loss_modulus", "gap", 5, 5e-4, 0.1, SmoothMisfit{.before = 0, .over_largest = true}}),
              "G'' rises relative to the base model along gap: mean difference 0 % before and 10 % from 0.5 mm on (of the largest "
              "predicted modulus)");
    EXPECT_EQ(
        sentence_on(
            Misfit{"third_harmonic_loss", "time", 5, 60, -0.01, SmoothMisfit{.base_is_zero = true, .time_is_stated = false}}),
        "the viscous part of the third harmonic falls below the base model along time (10 s a row where none is stated): mean "
        "difference 0 % before and -1 % from 60 s on (of the first)");
    EXPECT_EQ(sentence_on(Misfit{"exclusion_probability", "pore_radius", 5, 2e-6, 0.04, SmoothMisfit{}}),
              "the share of the void space in larger pores rises relative to the base model along pore_radius: mean difference 0 % "
              "before and 4 % from 2 um on (of the void space)");
}

/// "793 % before" says nothing to anybody.
TEST(FindingSentences, WhatExceedsTheBaseModelIsToldAsAFactor) {
    EXPECT_EQ(sentence_on(Misfit{"storage_modulus", "strain", 5, 0.02, -0.5, SmoothMisfit{.before = 7.93}}),
              "G' falls relative to the base model along strain: 8.93 times the base model before and 0.5 times from 2 % on");
    EXPECT_EQ(sentence_on(Misfit{"storage_modulus", "gap", 5, 5e-4, 3.1, SmoothMisfit{.before = 2.9, .is_the_same = true}}),
              "G' lies above the base model all along gap: 4 times the base model");
    EXPECT_NE(sentence_on(Misfit{"loss_modulus", "gap", 5, 5e-4, 1.1, SmoothMisfit{.before = 0, .over_largest = true}})
                  .find("110 % from 0.5 mm on (of the largest predicted modulus)"),
              std::string::npos);
}

TEST(FindingSentences, ADepartureThatStaysHasOneSize) {
    EXPECT_EQ(sentence_on(Misfit{"loss_modulus", "angular_frequency", 5, 1, 0.042,
                                 SmoothMisfit{.before = 0.038, .over_largest = true, .is_the_same = true}}),
              "G'' lies above the base model all along angular frequency: mean difference 4 % (of the largest predicted modulus)");
}

TEST(FindingSentences, LevelsSamplesAndImagesDepartByStandardDeviations) {
    EXPECT_EQ(sentence_on(Misfit{"storage_modulus", "normal_stiffness", 5, 52, 0.3, diagnose::LevelMisfit{40, 3.1}}),
              "the level of G' asks for a normal stiffness of 52 N/m, 3.1 standard deviations above the known 40 N/m");
    EXPECT_EQ(sentence_on(Misfit{"loss_modulus", "viscosity", 5, 0.9, -0.1, diagnose::LevelMisfit{1, -4}}),
              "the level asks for a viscosity of 0.9 Pa.s, 4 standard deviations below the known 1 Pa.s");
    EXPECT_EQ(sentence_on(Misfit{"storage_modulus", "sample", 5, 3, -0.5, diagnose::SampleMisfit{"C", -6}}),
              "sample 'C' as a whole lies 50 %, 6 standard deviations below the base model");
    EXPECT_EQ(
        sentence_on(Misfit{"localisation_axis", "frame", 5, unknown, 0.1, diagnose::ImageMisfit{0.1, 20}}),
        "images of the same particles scatter: a centre by 0.1 diameters along z, 20 standard deviations above exact centres");
    EXPECT_EQ(sentence_on(Misfit{"unmatched_share", "frame", 5, unknown, 0.05, diagnose::ImageMisfit{0.05, 9}}),
              "5 % of the centres of an image are not in the next one, 9 standard deviations above exact centres");
}

TEST(FindingSentences, ARemainderHasAPlaceAlongEachCoordinate) {
    EXPECT_EQ(sentence_on(diagnose::Remainder{}), "");
    EXPECT_EQ(sentence_on(diagnose::Remainder{
                  .observable = "loss_modulus", .largest = -0.09, .where = {{"angular_frequency", 1, 10}, {"strain", 0.01, 0.01}}}),
              "G'' lies below the model by up to 9 % of |G*|, at angular frequency 1 rad/s to 10 rad/s and strain 1 %");
}

TEST(FindingSentences, AProposalStatesItsLengthsAndItsRest) {
    EXPECT_EQ(words_for({.measurement = "amplitude-sweep-at-small-gap", .lengths = {2.5e-4}}),
              "an amplitude sweep on a fresh sample at a quarter of the gap (0.25 mm)");
    EXPECT_EQ(words_for({.measurement = "gap-series-with-rough-plates", .lengths = {1e-3 / 3, 3e-3}}),
              "a series of gaps from narrow to wide (0.333 to 3 mm) between rough plates, at which nothing slips");
    EXPECT_EQ(words_for({.measurement = "gap-series", .lengths = {3e-3, 1e-3}}),
              "a series of gaps from wide to narrow (3 to 1 mm)");
    EXPECT_EQ(words_for({.measurement = "frequency-sweep-under-small-plate", .lengths = {unknown}}),
              "a frequency sweep with a plate of half the radius");
    EXPECT_EQ(words_for({.measurement = "amplitude-sweep-and-again", .rest = 1800}),
              "an amplitude sweep on a fresh sample, and the same again after a rest of 30 min");
    EXPECT_THROW(words_for({.measurement = "nothing"}), std::out_of_range);
}

}  // namespace
}  // namespace coagula::report
