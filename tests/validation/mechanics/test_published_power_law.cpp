// SPDX-License-Identifier: GPL-3.0-or-later
// The power law through the eleven published moduli (Schenker et al. 2012, table 2, sec. 3.2: a0 = 0.373 +- 0.001, beta = 0.187 +-
// 0.032), and what they say about its critical value.
#include <coagula/mechanics/power_law.hpp>

#include "support/reference_data.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coagula::mechanics {
namespace {

using namespace coagula::testing;

/// doh_a and G_Pa: fields 4 and 6 of each row, after comments and a header.
PowerLawData published_data() {
    std::ifstream file = open_dataset(dataset("schenker2012/published_structures.csv"));
    std::vector<double> a, modulus;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#') || line.starts_with("generator")) {
            continue;
        }
        std::istringstream cells(line);
        std::vector<std::string> fields;
        for (std::string cell; std::getline(cells, cell, ',');) {
            fields.push_back(cell);
        }
        a.push_back(std::stod(fields.at(3)));
        modulus.push_back(std::stod(fields.at(5)));
    }
    const auto count = static_cast<Index>(a.size());
    return {Eigen::VectorXd::Map(a.data(), count), Eigen::VectorXd::Map(modulus.data(), count), {}};
}

TEST(PublishedPowerLaw, CriticalValueAndExponent) {
    const PowerLawData data = published_data();
    ASSERT_EQ(data.a.size(), 11);
    const PowerLawFit fit = fit_power_law(data).fit;
    EXPECT_EQ(fit.minimum, PowerLawMinimum::inside);
    // The minimum of an independent scan of 30 000 exponents at each a0, and its values on the way there.
    EXPECT_NEAR(fit.law.a0, 0.37277, 1e-5);
    EXPECT_NEAR(fit.law.beta, 0.19140, 2e-4);
    EXPECT_NEAR(fit.law.sum_of_squares / 1.239767e11, 1, 1e-5);
    const PowerLaw before = fit_power_law_at(data, 0.3725);
    EXPECT_NEAR(before.beta, 0.20196, 1e-4);
    EXPECT_NEAR(before.sum_of_squares / 1.272791e11, 1, 1e-5);
    EXPECT_NEAR(fit.law.a0, 0.373, 0.001) << "published";
    EXPECT_NEAR(fit.law.beta, 0.187, 0.032) << "published";
}

/// Without the structure of the smallest a (brownian, 0 mV) nearly any critical value does.
TEST(PublishedPowerLaw, RestsOnOneStructure) {
    const PowerLawData data = published_data();
    const PowerLawAnalysis found = fit_power_law(data);
    Index lowest = 0;
    data.a.minCoeff(&lowest);
    EXPECT_EQ(found.decisive, lowest);
    const PowerLawFit& without = found.without.at(static_cast<std::size_t>(lowest));
    EXPECT_NEAR(without.law.a0, 0.360, 5e-4) << "published: 0.360";
    EXPECT_FALSE(without.bounded_below && without.bounded_above) << without.a0_low << " .. " << without.a0_high;

    PowerLawData rest = data;
    rest.a << data.a.head(lowest), data.a.tail(10 - lowest), 0;
    rest.modulus << data.modulus.head(lowest), data.modulus.tail(10 - lowest), 0;
    rest.a.conservativeResize(10);
    rest.modulus.conservativeResize(10);
    for (double a0 = 0.34; a0 < 0.3701; a0 += 0.002) {
        const double squares = fit_power_law_at(rest, a0).sum_of_squares;
        EXPECT_LT(squares, 1.02 * without.law.sum_of_squares) << a0;
        EXPECT_GE(squares, without.law.sum_of_squares);
    }
}

}  // namespace
}  // namespace coagula::mechanics
