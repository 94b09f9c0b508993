// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/spelling.hpp>

#include <gtest/gtest.h>

namespace coagula {
namespace {

TEST(Spelling, CountsEdits) {
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("shaer", "shear"), 1U);  // neighbours swapped
    EXPECT_EQ(edit_distance("ca", "abc"), 3U);       // no further edit within a swapped pair
    EXPECT_EQ(edit_distance("voids", "voids"), 0U);
}

TEST(Spelling, IsAMetricOnShortWords) {
    const std::vector<std::string> words = {"shear", "shera", "hear", "share", "sheer"};
    for (const std::string& a : words) {
        for (const std::string& b : words) {
            EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
            EXPECT_EQ(edit_distance(a, b) == 0, a == b);
        }
    }
}

TEST(Spelling, FindsWhatWasMeant) {
    const std::vector<std::string> names = {"normal-stiffness", "shear-stiffness", "bond-tolerance", "force", "frequency"};
    EXPECT_EQ(nearest_name("normal-stifness", names), "normal-stiffness");
    EXPECT_EQ(nearest_name("normal_stiffness", names), "normal-stiffness");
    EXPECT_EQ(nearest_name("Force", names), "force");
    EXPECT_EQ(nearest_name("freq", names), "frequency");
    EXPECT_EQ(nearest_name("colour", names), "");
    EXPECT_EQ(nearest_name("", names), "");
    EXPECT_EQ(nearest_name("f", names), "");
    EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
    EXPECT_EQ(did_you_mean("forse", names, "--"), "; did you mean '--force'?");
    EXPECT_EQ(did_you_mean("colour", names), "");
}

}  // namespace
}  // namespace coagula
