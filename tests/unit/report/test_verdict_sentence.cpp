// SPDX-License-Identifier: GPL-3.0-or-later
// What a verdict says in words.
#include <gtest/gtest.h>

#include <coagula/report/diagnosis_page.hpp>

#include <string>
#include <utility>
#include <vector>

namespace coagula::report {
namespace {

using Names = std::vector<std::string>;

std::string tied(Names set, Names certain) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    found.verdict = diagnose::Verdict::tied;
    found.credible_set = std::move(set);
    found.certain = std::move(certain);
    return verdict_sentence(found);
}

TEST(VerdictSentence, CausesThatTie) {
    EXPECT_EQ(tied({"wall-slip", "gap-error", "none of the catalogue"}, {}),
              "The base model fails (p ≤ 0.001); these data cannot tell whether the cause is wall-slip, gap-error or none of the "
              "catalogue.");
}

TEST(VerdictSentence, ACauseAloneOrWithAnother) {
    EXPECT_EQ(
        tied({"ageing", "ageing + contact-relaxation"}, {"ageing"}),
        "The base model fails (p ≤ 0.001), and ageing is a cause. These data cannot tell whether contact-relaxation is another.");
}

TEST(VerdictSentence, ACauseWithOneOfTwoOthers) {
    EXPECT_EQ(
        tied({"tool-inertia + solvent-drag", "phase-offset + tool-inertia"}, {"tool-inertia"}),
        "The base model fails (p ≤ 0.001), and tool-inertia is one cause. There is another; these data cannot tell whether that is "
        "solvent-drag or phase-offset.");
}

TEST(VerdictSentence, TheBoxHoldsWhatIsLeftOverAndWhatToMeasureNext) {
    diagnose::Diagnosis found;
    found.detected = true;
    found.p_value = 0.001;
    found.base.name = "base";
    for (const char* name : {"wall-slip", "gap-error"}) {
        diagnose::Cause cause;
        cause.name = name;
        cause.parameters.emplace_back();
        found.causes.push_back(cause);
    }
    found.credible_set = {"wall-slip", "gap-error"};
    found.remainder = {.detected = true, .where = "G' lies above the model by up to 9 % of |G*|"};
    found.proposals = {{.what = "an oil", .information = 1, .resolution = 0.9}};
    for (const diagnose::Verdict verdict :
         {diagnose::Verdict::tied, diagnose::Verdict::none_of_catalogue, diagnose::Verdict::named}) {
        found.verdict = verdict;
        const Names sentences = verdict_sentences(found);
        ASSERT_EQ(sentences.size(), 3U);
        EXPECT_EQ(sentences[0], verdict_sentence(found));
        EXPECT_EQ(sentences[1], "The best cause, wall-slip, leaves a deviation: G' lies above the model by up to 9 % of |G*|.");
        EXPECT_EQ(sentences[2], "To decide, measure an oil.");
    }
    found.remainder.most = true;
    EXPECT_NE(verdict_sentences(found)[1].find("leaves most of the misfit: "), std::string::npos);
    found.remainder.detected = false;
    found.proposals.clear();
    EXPECT_EQ(verdict_sentences(found).size(), 1U);
}

}  // namespace
}  // namespace coagula::report
