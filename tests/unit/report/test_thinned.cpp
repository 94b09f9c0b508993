// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a large structure that a page shows.
#include <coagula/common/contact_network.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "thinned.hpp"

namespace coagula::report {
namespace {

/// A cubic lattice of touching spheres of radius 1 in a periodic box of n x n x 2 n; each particle has its number as a value, each
/// bond the sum of those of its ends.
PageStructure lattice_page(int n) {
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d(2 * n, 2 * n, 4 * n));
    packing.positions.resize(3, 2 * n * n * n);
    for (int k = 0; k < 2 * n * n * n; ++k) {
        packing.positions.col(k) = Eigen::Vector3d(2 * (k % n) + 1, 2 * (k / n % n) + 1, 2 * (k / (n * n)) + 1);
    }
    packing.radii = Eigen::VectorXd::Ones(packing.size());
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    Eigen::MatrixXd numbers(2, packing.size());  // a vector field
    numbers << Eigen::RowVectorXd::LinSpaced(packing.size(), 0, static_cast<double>(packing.size() - 1)),
        Eigen::RowVectorXd::Constant(packing.size(), -1);
    Eigen::VectorXi sums(bonds.size());
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        sums[bond] = bonds.ends(0, bond) + bonds.ends(1, bond);
    }
    PageStructure page{.name = "lattice", .structure = {packing, bonds}, .fields = {}, .results = {}, .history = {}};
    page.fields = {io::columns("/VTKHDF/PointData/number", numbers, "1", "")};
    page.results = {io::integers("/mechanics/linear/xy/bonds/sum", sums, ""),
                    io::scalar("/characterization/coordination", 6, "1", "")};
    page.pores.centres = packing.positions.array() + 1;
    page.pores.radii = Eigen::VectorXd::Constant(packing.size(), 0.7);
    return page;
}

TEST(Thinned, SmallStructuresStayAsTheyAre) {
    const PageStructure page = lattice_page(3);
    for (const Index most : {Index{54}, Index{1000}}) {
        const PageStructure same = thinned(page, most);
        EXPECT_EQ(same.structure.packing.positions, page.structure.packing.positions);
        EXPECT_TRUE(same.structure.packing.cell.is_periodic());
        EXPECT_EQ(same.structure.bonds->ends, page.structure.bonds->ends);
    }
    EXPECT_THROW(thinned(page, 0), std::invalid_argument);
}

TEST(Thinned, ShowsTheMiddleInACellOfTheSameProportions) {
    const PageStructure page = lattice_page(8);  // of 1024 particles the middle 4 x 4 x 8
    const PageStructure part = thinned(page, 128);
    const Packing& packing = part.structure.packing;
    ASSERT_EQ(packing.size(), 128);
    EXPECT_FALSE(packing.cell.is_periodic());
    const Eigen::Vector3d lengths = packing.cell.lengths();
    EXPECT_NEAR(lengths[2] / lengths[0], 2, 1e-12);
    EXPECT_NEAR((packing.cell.origin() + lengths / 2 - page.structure.packing.cell.lengths() / 2).norm(), 0, 1e-12);
    EXPECT_EQ(packing.positions.row(0).minCoeff(), 5);
    EXPECT_EQ(packing.positions.row(0).maxCoeff(), 11);
    EXPECT_EQ(packing.positions.row(2).minCoeff(), 9);
    EXPECT_EQ(packing.positions.row(2).maxCoeff(), 23);
    EXPECT_EQ(part.structure.bonds->size(), 3 * 4 * 8 * 2 + 4 * 4 * 7);
    EXPECT_GT(part.pores.size(), 0);
    EXPECT_LT(part.pores.size(), page.pores.size());
}

TEST(Thinned, ValuesGoWithTheirParticlesAndBonds) {
    const PageStructure page = lattice_page(6);
    for (const Index most : {1, 7, 50, 200, 431}) {
        const PageStructure part = thinned(page, most);
        const auto& numbers = std::get<std::vector<double>>(part.fields[0].values);
        ASSERT_EQ(numbers.size(), static_cast<std::size_t>(2 * most));
        EXPECT_EQ(part.fields[0].shape, (std::vector<std::size_t>{static_cast<std::size_t>(most), 2}));
        for (Index k = 0; k < most; ++k) {
            const auto before = static_cast<Index>(numbers[static_cast<std::size_t>(2 * k)]);
            EXPECT_EQ(part.structure.packing.positions.col(k), page.structure.packing.positions.col(before));
            EXPECT_EQ(numbers[static_cast<std::size_t>(2 * k + 1)], -1);
        }
        const ContactNetwork& bonds = *part.structure.bonds;
        const auto& sums = std::get<std::vector<std::int64_t>>(part.results[0].values);
        ASSERT_EQ(sums.size(), static_cast<std::size_t>(bonds.size()));
        for (Index bond = 0; bond < bonds.size(); ++bond) {
            const auto number = [&](Index end) { return numbers[static_cast<std::size_t>(2 * bonds.ends(end, bond))]; };
            EXPECT_EQ(static_cast<double>(sums[static_cast<std::size_t>(bond)]), number(0) + number(1));
            const Eigen::Vector3d direct = part.structure.packing.positions.col(bonds.ends(1, bond)) -
                                           part.structure.packing.positions.col(bonds.ends(0, bond));
            EXPECT_EQ(direct, bonds.branch.col(bond));
        }
        EXPECT_EQ(part.results[1].shape, page.results[1].shape);
    }
}

}  // namespace
}  // namespace coagula::report
