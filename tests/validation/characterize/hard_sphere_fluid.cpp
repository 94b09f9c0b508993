// SPDX-License-Identifier: GPL-3.0-or-later
// A hard-sphere fluid at volume fraction 0.4, equilibrated by Monte Carlo: contact value of Carnahan and Starling, structure factor
// of Percus and Yevick, and the order of a fluid.
#include "hard_sphere_fluid.hpp"

#include <coagula/characterize/bond_order.hpp>
#include <coagula/characterize/local_structure.hpp>
#include <coagula/characterize/pair_correlation.hpp>
#include <coagula/characterize/structure_factor.hpp>

#include <gtest/gtest.h>

namespace coagula::characterize {
namespace {

using test::Average;
constexpr double fraction = test::fluid_fraction;

/// 1 / (1 - n c(q)) with the direct correlation function of Percus and Yevick, a cubic polynomial of r (Wertheim, Phys. Rev. Lett.
/// 10 (1963) 321). @param q in units of 1 / diameter.
double percus_yevick(double q) {
    const double first = std::pow(1 + 2 * fraction, 2) / std::pow(1 - fraction, 4);
    const double second = -std::pow(1 + fraction / 2, 2) / std::pow(1 - fraction, 4);
    constexpr int steps = 2000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double x = (k + 0.5) / steps;
        sum += (first + 6 * fraction * second * x + fraction * first / 2 * x * x * x) * x * std::sin(q * x) / q / steps;
    }
    return 1 / (1 + 24 * fraction * sum);
}

TEST(HardSphereFluid, HasTheTabulatedStructure) {
    test::Fluid fluid;
    fluid.sweep(1500);
    constexpr int configurations = 40;
    Average contact, contact_error, at_zero, q6, crystal;
    std::vector<Average> direct, transformed;
    StructureFactor last;
    for (int k = 0; k < configurations; ++k) {
        fluid.sweep(40);
        const PairCorrelation pairs = measure_pair_correlation(fluid.packing(), {.contact_tolerance = 0.002});
        EXPECT_TRUE((pairs.by_contact.g.head(pairs.by_contact.contact_bin).array() == 0).all());
        contact.add(pairs.contact_value);
        contact_error.add(pairs.contact_value_stderr);
        last = measure_structure_factor(fluid.packing(), {.largest = 20});
        at_zero.add(last.at_zero);
        direct.resize(static_cast<std::size_t>(last.direct.size()));
        transformed.resize(direct.size());
        for (std::size_t shell = 0; shell < direct.size(); ++shell) {
            direct[shell].add(last.direct[static_cast<Index>(shell)]);
            transformed[shell].add(last.transformed[static_cast<Index>(shell)]);
        }
        q6.add(measure_bond_order(fluid.packing()).q6_mean);
        const CommonNeighbours order = measure_common_neighbours(fluid.packing());
        crystal.add(order.fcc + order.hcp + order.bcc);
    }
    // Carnahan and Starling, J. Chem. Phys. 51 (1969) 635: 3.704.
    const double carnahan_starling = (1 - fraction / 2) / std::pow(1 - fraction, 3);
    EXPECT_NEAR(contact.mean(), carnahan_starling, 4 * contact.error());
    EXPECT_LT(contact.error(), 0.02 * carnahan_starling);
    EXPECT_NEAR(contact_error.mean() / (contact.error() * std::sqrt(configurations)), 1, 0.5);
    // The compressibility of the same equation: 0.0431.
    const double compressibility =
        std::pow(1 - fraction, 4) / (std::pow(1 + 2 * fraction, 2) + std::pow(fraction, 3) * (fraction - 4));
    EXPECT_NEAR(at_zero.mean(), compressibility, 4 * at_zero.error());
    EXPECT_LT(at_zero.error(), 0.01);
    // The transform of g(r) up to half the box does not see waves longer than that.
    const double resolved = 4 * std::numbers::pi / fluid.packing().cell.lengths().minCoeff();
    // Percus and Yevick are themselves off by up to 4 % of the peak at this fraction.
    double largest = 0;
    for (std::size_t shell = 0; shell < direct.size(); ++shell) {
        const double exact = percus_yevick(last.wave_number[static_cast<Index>(shell)]);
        largest = std::max(largest, exact);
        EXPECT_NEAR(direct[shell].mean(), exact, 4 * direct[shell].error() + 0.04 * exact)
            << last.wave_number[static_cast<Index>(shell)];
        if (last.wave_number[static_cast<Index>(shell)] >= resolved) {
            EXPECT_NEAR(transformed[shell].mean(), exact,
                        4 * transformed[shell].error() + last.transformed_error[static_cast<Index>(shell)] + 0.04 * exact)
                << last.wave_number[static_cast<Index>(shell)];
        }
    }
    EXPECT_GT(largest, 1.9);
    EXPECT_LT(crystal.mean(), 0.01);
    EXPECT_GT(q6.mean(), 0.35);
    EXPECT_LT(q6.mean(), 0.42);
}

}  // namespace
}  // namespace coagula::characterize
