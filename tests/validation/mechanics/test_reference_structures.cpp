// SPDX-License-Identifier: GPL-3.0-or-later
// Shear moduli of five packings against values computed independently (conjugate gradients to 1e-8 by another program).
#include <coagula/mechanics/linear.hpp>

#include "support/reference_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

struct Published {
    const char* name;
    double xy, xz, yz;  // MPa
};

void PrintTo(const Published& structure, std::ostream* out) {
    *out << structure.name;
}

class ReferenceStructure : public ::testing::TestWithParam<Published> {};

TEST_P(ReferenceStructure, ShearModuli) {
    const Published expected = GetParam();
    const Packing packing = reference_structure(expected.name);
    const auto response = solve_linear(packing, find_contacts(packing, 0.01));
    EXPECT_NEAR(response.shear_modulus(0, 1) / 1e6, expected.xy, 1e-4);
    EXPECT_NEAR(response.shear_modulus(0, 2) / 1e6, expected.xz, 1e-4);
    EXPECT_NEAR(response.shear_modulus(1, 2) / 1e6, expected.yz, 1e-4);
    EXPECT_LT(response.residual, 2e-10);
}

INSTANTIATE_TEST_SUITE_P(Five, ReferenceStructure,
                         ::testing::Values(Published{"vem_1-8", 1.4651, 1.3968, 1.5417},
                                           Published{"vem_1-2", 1.4759, 1.358, 1.3256},
                                           Published{"vem_2-1", 0.8257, 0.9326, 0.8719},
                                           Published{"brownian_0mV", 1.4955, 1.5847, 1.532},
                                           Published{"brownian_15mV", 1.393, 1.4424, 1.4259}),
                         [](const auto& structure) {
                             std::string name = structure.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace coagula::mechanics
