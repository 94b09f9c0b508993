// SPDX-License-Identifier: GPL-3.0-or-later
// What a verdict says in words.
#include <gtest/gtest.h>

#include <coagula/report/diagnosis_page.hpp>

#include <string>
#include <utility>
#include <vector>

namespace coagula::report {
namespace {

using diagnose::CauseSet;
using Names = std::vector<std::string>;

CauseSet unknown() {
    return CauseSet::none_of_catalogue();
}

CauseSet causes(const Names& names) {
    diagnose::Hypothesis mechanisms;
    for (const std::string& name : names) {
        mechanisms.push_back(diagnose::find_mechanism(name));
    }
    return mechanisms;
}

std::string tied(std::vector<CauseSet> set, CauseSet certain) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    found.verdict = diagnose::Verdict::tied;
    found.credible_set = std::move(set);
    found.certain = std::move(certain);
    return verdict_sentence(found);
}

TEST(VerdictSentence, CausesThatTie) {
    EXPECT_EQ(tied({causes({"wall-slip"}), causes({"gap-error"}), unknown()}, {}),
              "The base model fails (p ≤ 0.001); these data cannot tell whether the cause is wall-slip, gap-error or none of the "
              "catalogue.");
}

TEST(VerdictSentence, ACauseAloneOrWithAnother) {
    EXPECT_EQ(
        tied({causes({"ageing"}), causes({"ageing", "contact-relaxation"})}, causes({"ageing"})),
        "The base model fails (p ≤ 0.001), and ageing is a cause. These data cannot tell whether contact-relaxation is another.");
}

TEST(VerdictSentence, ACauseWithOneOfTwoOthers) {
    EXPECT_EQ(
        tied({causes({"tool-inertia", "solvent-drag"}), causes({"phase-offset", "tool-inertia"})}, causes({"tool-inertia"})),
        "The base model fails (p ≤ 0.001), and tool-inertia is one cause. There is another; these data cannot tell whether that is "
        "solvent-drag or phase-offset.");
}

TEST(VerdictSentence, TheBoxHoldsWhatIsLeftOverAndWhatToMeasureNext) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    for (const char* name : {"wall-slip", "gap-error"}) {
        diagnose::Cause cause;
        cause.set = causes({name});
        cause.parameters.emplace_back();
        found.causes.push_back(cause);
    }
    found.credible_set = {causes({"wall-slip"}), causes({"gap-error"})};
    found.best = causes({"wall-slip"});
    found.follows = {.kind = {diagnose::Link::geometry, diagnose::Axis::gap},
                     .posterior = 0.99,
                     .link_is_told = true,
                     .change = 0.4,
                     .largest = 0.3,
                     .from = 5e-4,
                     .to = 2e-3};
    found.remainder = {.detected = true, .observable = "storage_modulus", .largest = 0.09};
    found.proposals = {{.measurement = "amplitude-sweep", .information = 1, .resolution = 0.9}};
    for (const diagnose::Verdict verdict :
         {diagnose::Verdict::tied, diagnose::Verdict::none_of_catalogue, diagnose::Verdict::named}) {
        found.verdict = verdict;
        const Names sentences = verdict_sentences(found);
        const bool is_named = verdict == diagnose::Verdict::named;
        ASSERT_EQ(sentences.size(), is_named ? 3U : 4U);
        EXPECT_EQ(sentences[0], verdict_sentence(found));
        if (!is_named) {
            EXPECT_EQ(
                sentences[1],
                "What is certain: the deviation follows the gap, by +40 % of |G*| from 500\u00A0µm to 2\u00A0mm. It acts like "
                "what plates do to the strain or to the rim. Causes of that kind: wall-slip or gap-error.");
        }
        EXPECT_EQ(sentences[sentences.size() - 2],
                  "The best cause, wall-slip, leaves a deviation: G' lies above the model by up to 9 % of |G*|.");
        EXPECT_EQ(sentences.back(), "To decide, measure an amplitude sweep on a fresh sample.");
    }
    found.remainder.most = true;
    EXPECT_NE(verdict_sentences(found)[1].find("leaves most of the misfit: "), std::string::npos);
    found.remainder.detected = false;
    found.proposals.clear();
    EXPECT_EQ(verdict_sentences(found).size(), 1U);
    found.verdict = diagnose::Verdict::none_of_catalogue;
    EXPECT_NE(verdict_sentences(found).back().find("an oil of known viscosity"), std::string::npos)
        << "something is advised always";
}

TEST(VerdictSentence, WhatAKindWithoutANameLacks) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    diagnose::Cause cause;
    cause.set = causes({"ageing"});
    cause.parameters.emplace_back();
    found.causes = {cause};
    found.best = cause.set;
    found.verdict = diagnose::Verdict::kind_only;
    found.follows = {.kind = {diagnose::Link::history, diagnose::Axis::time},
                     .posterior = 0.7,
                     .change = -0.12,
                     .largest = -0.08,
                     .from = 10,
                     .to = 1200};
    found.conditions = {{"inside-range", 1, 0, false}, {"beats-free-forms", 8, 3, true}, {"without-any-row", 2, 6, false}};
    const Names sentences = verdict_sentences(found);
    EXPECT_EQ(
        sentences[0],
        "The base model fails (p ≤ 0.001); no cause is certain. The most probable is ageing, but a value lies at the end of its "
        "physical range and it rests on a single row.");
    EXPECT_EQ(sentences[1],
              "The deviation probably follows the time since the sample was loaded, by −12 % of |G*| from 10\u00A0s to 1200\u00A0s "
              "(probability 70 %). It acts like a change of the sample with its history, but nothing that was measured tells that "
              "from what else follows the same. Causes of that kind: ageing.");
}

TEST(VerdictSentence, ACauseOrOneThatNobodyKnows) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    found.verdict = diagnose::Verdict::tied;
    found.credible_set = {causes({"contact-loss"}), unknown()};
    found.conditions = {{"separated", 0, 1, false}};
    EXPECT_EQ(verdict_sentence(found),
              "The base model fails (p ≤ 0.001); contact-loss explains the data, but nothing that was measured tells it from "
              "look-alikes outside the catalogue. The cause may be another one, which the catalogue does not have.");
}

TEST(VerdictSentence, SamplesThatDifferBetweenPlatesAreFilledAgain) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.verdict = diagnose::Verdict::none_of_catalogue;
    diagnose::Cause cause;
    cause.set = causes({"gap-error"});
    cause.parameters.emplace_back();
    found.causes = {cause};
    found.best = cause.set;
    found.follows = {.kind = {diagnose::Link::history, diagnose::Axis::gap}, .posterior = 0.99, .link_is_told = true};
    const Names sentences = verdict_sentences(found);
    EXPECT_NE(sentences[1].find("It acts like samples that differ or were filled otherwise"), std::string::npos) << sentences[1];
    EXPECT_NE(sentences.back().find("Fill every gap and plate with several samples"), std::string::npos) << sentences.back();
}

/// A cause says itself what tells it from others.
TEST(VerdictSentence, WhatTellsACauseFromItsLookAlikes) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.verdict = diagnose::Verdict::tied;
    found.credible_set = {causes({"gap-error"}), unknown()};
    diagnose::Cause cause;
    cause.set = causes({"gap-error"});
    found.causes = {cause};
    found.best = cause.set;
    found.follows.kind = {diagnose::Link::geometry, diagnose::Axis::gap};
    found.conditions = {{"separated", 0, 1, false}};
    EXPECT_EQ(what_separates(found), "an oil of known viscosity at the same gaps");
    EXPECT_EQ(verdict_sentences(found).back(), "To name it, measure an oil of known viscosity at the same gaps.");
    found.conditions.push_back({"little-left", 1, 0, false});
    EXPECT_EQ(what_separates(found), "") << "an oil alone would not name it";
    found.conditions = {{"separated", 1, 1, true}};
    EXPECT_EQ(what_separates(found), "");
    EXPECT_EQ(verdict_sentences(found).back().find("To name it"), std::string::npos);
}

}  // namespace
}  // namespace coagula::report
