// SPDX-License-Identifier: GPL-3.0-or-later
// Small twin of the benchmark tests/benchmark/vem: void expansion gives the published coordination and degree of heterogeneity
// (Schenker et al. 2012, table 2: N = 8000, N_V = 1000 .. 16 000), here with N = 1000 at the same N_V/N.
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace coagula::generators {
namespace {

TEST(VoidExpansionTwin, HasThePublishedCoordinationAndHeterogeneity) {
    struct Row {
        Index voids;
        double published_a;
    };
    double last_a = 1;
    for (const Row row : {Row{125, 0.594}, Row{500, 0.467}, Row{2000, 0.392}}) {
        VoidExpansionOptions options;
        options.particles = 1000;
        options.voids = row.voids;
        options.volume_fraction = 0.4;
        options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
        const VoidExpansion result = expand_voids(options);
        EXPECT_NEAR(result.coordination, 4.69, 0.1);
        EXPECT_LT(result.overlap_rms, 0.005);
        const auto pores = characterize::measure_pores(result.packing);
        const double a = characterize::fit_degree_of_heterogeneity(pores, 0.25e-6).a;
        // Eight times fewer particles scatter more than the 4 % that hold for N = 8000.
        EXPECT_NEAR(a / row.published_a, 1, 0.08) << "N_V = " << row.voids;
        EXPECT_LT(a, last_a - 0.04) << "more voids must make the packing more homogeneous";
        last_a = a;
        RecordProperty("a_" + std::to_string(row.voids), std::to_string(a));
        std::printf("N_V/N = %.3f: a = %.3f (published, N = 8000: %.3f), C = %.2f\n", static_cast<double>(row.voids) / 1000, a,
                    row.published_a, result.coordination);
    }
}

}  // namespace
}  // namespace coagula::generators
