// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/cell_list.hpp>
#include <coagula/common/dem/particle_system.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace coagula {
namespace {

Eigen::Matrix3Xd some_places() {
    return Eigen::Matrix3Xd::Constant(3, 5, 0.5);
}

TEST(CellList, RefusesPlacesThatAreNoNumbers) {
    const Cell cell = Cell::periodic({2, 2, 2});
    EXPECT_NO_THROW(CellList(cell, some_places(), 0.5));
    for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        Eigen::Matrix3Xd places = some_places();
        places(1, 3) = wrong;
        EXPECT_THROW(CellList(cell, places, 0.5), std::invalid_argument);
        EXPECT_THROW(CellList(Cell::open({0, 0, 0}, {2, 2, 2}), places, 0.5), std::invalid_argument);
        EXPECT_ANY_THROW(dem::ParticleSystem(cell, places, Eigen::VectorXd::Constant(5, 0.1), 0.1));
    }
}

TEST(Cell, RefusesAVolumeBeyondTheRangeOfNumbers) {
    for (const double edge : {1e150, 1e-150}) {
        EXPECT_THROW(Cell::periodic({edge, edge, edge}), std::invalid_argument);
    }
}

}  // namespace
}  // namespace coagula
