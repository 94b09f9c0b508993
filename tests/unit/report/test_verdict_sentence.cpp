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

}  // namespace
}  // namespace coagula::report
