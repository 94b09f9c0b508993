// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli with errors: what the drag of a solvent adds is known up to factors.
#include "chain/uncertain_moduli.hpp"

#include <gtest/gtest.h>

#include <complex>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;

UncertainModuli of_two_numbers() {
    UncertainModuli moduli(Eigen::Vector2cd(Complex(3, 1), Complex(5, 2)), Eigen::Vector2cd(Complex(0.3, 0.1), Complex(-0.2, 0)));
    moduli.dragged = Eigen::Vector2cd(Complex(0.2, 0.3), Complex(0.6, 0.1));
    moduli.excess = Eigen::Vector2cd(Complex(0.4, -0.1), Complex(0.2, 0));
    moduli.logarithms.resize(2, 2);
    moduli.logarithms << Complex(1.3, 0.2), Complex(0.3, 0), Complex(0.7, -0.4), Complex(-1, 0.1);
    return moduli;
}

TEST(UncertainModuli, DragGrowsByAFactorAndTheRestAdds) {
    const UncertainModuli moduli = of_two_numbers();
    ASSERT_EQ(moduli.errors(), 3);
    const Eigen::Vector3d errors{0.5, 2, -1};
    const Eigen::VectorXcd found = moduli.with(errors);
    const Complex springs = Complex(3.15, 1.05) * (1.0 - Complex(0.2, 0.3));
    const Complex drag =
        Complex(3.15, 1.05) * Complex(0.2, 0.3) * std::exp(Complex(0.4, -0.1) + Complex(2.6, 0.4) - Complex(0.3, 0));
    EXPECT_LT(std::abs(found[0] - springs - drag), 1e-12 * std::abs(drag));
}

TEST(UncertainModuli, TangentsAreTheSlopes) {
    constexpr double step = 1e-6;
    const UncertainModuli moduli = of_two_numbers();
    const Eigen::Vector3d errors{-0.4, 1.2, 0.3};
    const Eigen::MatrixXcd tangents = moduli.tangents(errors);
    for (Eigen::Index error = 0; error < 3; ++error) {
        const Eigen::Vector3d move = step * Eigen::Vector3d::Unit(error);
        const Eigen::VectorXcd slope = (moduli.with(errors + move) - moduli.with(errors - move)) / (2 * step);
        EXPECT_LT((tangents.col(error + 1) - slope).norm(), 1e-7 * slope.norm()) << error;
    }
    EXPECT_EQ(tangents.col(0), moduli.with(errors));
}

}  // namespace
}  // namespace coagula::diagnose
