// SPDX-License-Identifier: GPL-3.0-or-later
// Frequency response against causality and, on a packing of 8000 spheres, against the elastic solver.
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include "support/reference_data.hpp"
#include "unit/mechanics/networks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

// Kramers and Kronig in the limit of high frequency: G'(inf) - G'(0) = (2 / pi) integral of G''(w) d ln w. Below and above the grid
// G'' falls as w and 1 / w, so that each tail adds G'' at its end.
TEST(FrequencyResponse, StorageAndLossObeyKramersAndKronig) {
    const Packing packing = random_spheres(120, 10.0, 0.25e-6, 21);
    const ContactNetwork bonds = find_contacts(packing, 0.02);
    ContactModel model;
    model.normal_maxwell_stiffness = 70;
    model.normal_maxwell_time = 0.01;
    model.shear_maxwell_stiffness = 20;
    model.shear_maxwell_time = 0.3;
    constexpr int points = 121;
    const double step = std::log(1e10) / (points - 1);
    std::vector<double> frequencies;
    for (int k = 0; k < points; ++k) {
        frequencies.push_back(1e-4 * std::exp(step * k));
    }
    const auto response = solve_frequency_sweep(packing, bonds, model, frequencies);
    double integral = 0;
    for (int k = 0; k < points; ++k) {
        const double loss = response.points[static_cast<std::size_t>(k)].mean_shear_modulus().imag();
        const bool is_end = k == 0 || k == points - 1;
        integral += is_end ? (0.5 * step + 1) * loss : step * loss;
    }
    const double slow = solve_linear(packing, bonds).mean_shear_modulus();
    LinearOptions stiff;
    stiff.normal_stiffness = 100 + 2 * model.normal_maxwell_stiffness;  // of a particle, two in series
    stiff.shear_stiffness = 10 + 2 * model.shear_maxwell_stiffness;
    const double fast = solve_linear(packing, bonds, stiff).mean_shear_modulus();
    ASSERT_GT(fast, 1.5 * slow);
    EXPECT_NEAR(2 / std::numbers::pi * integral, fast - slow, 1e-5 * fast);
}

TEST(FrequencyResponse, WithoutLossesAReferenceStructureIsElastic) {
    const Packing packing = reference_structure("vem_1-2");
    const auto bonds = find_contacts(packing, 0.01);
    const auto linear = solve_linear(packing, bonds);
    const auto response = solve_frequency_sweep(packing, bonds, {}, std::array{1.0});
    const Eigen::Matrix<double, 6, 6> storage = response.points.at(0).modulus.real();
    EXPECT_LT((storage - linear.elastic_tensor).norm(), 1e-9 * linear.elastic_tensor.norm());
    EXPECT_EQ(response.rattlers, linear.rattlers);
}

}  // namespace
}  // namespace coagula::mechanics
