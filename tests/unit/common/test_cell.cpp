// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of any shape, periodic along any edges, against sums over all images.
#include <coagula/common/cell.hpp>
#include <coagula/common/cell_list.hpp>
#include <coagula/common/random.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <map>

namespace coagula {
namespace {

Eigen::Vector3d uniform(std::uint64_t stream, std::uint64_t number) {
    return random_uniform(5, RandomPurpose::test, stream, number);
}

/// The first edge along x, the second in the plane of x and y, tilts up to `tilt` lengths; then turned.
Cell random_cell(std::uint64_t number, double tilt, const std::array<bool, 3>& periodic) {
    const Eigen::Vector3d lengths = Eigen::Vector3d::Ones() + 2 * uniform(1, number);
    const Eigen::Vector3d tilts = tilt * (2 * uniform(2, number) - Eigen::Vector3d::Ones());
    Eigen::Matrix3d edges = lengths.asDiagonal();
    edges(0, 1) = tilts[0] * lengths[0];
    edges(0, 2) = tilts[1] * lengths[0];
    edges(1, 2) = tilts[2] * lengths[1];
    if (number % 2 == 1) {
        edges = Eigen::Quaterniond(1, 0.3, -0.5, 0.2).normalized().toRotationMatrix() * edges;
    }
    return Cell::of_edges(uniform(3, number), edges, periodic);
}

constexpr std::array<std::array<bool, 3>, 5> boundaries = {
    {{true, true, true}, {true, true, false}, {false, true, true}, {false, false, true}, {false, false, false}}};

template <class Visit>
void for_each_image(const Cell& cell, int reach, const Visit& visit) {
    const auto most = [&](int axis) { return cell.is_periodic(axis) ? reach : 0; };
    for (int x = -most(0); x <= most(0); ++x) {
        for (int y = -most(1); y <= most(1); ++y) {
            for (int z = -most(2); z <= most(2); ++z) {
                visit(Eigen::Vector3d(cell.edges() * Eigen::Vector3d(x, y, z)));
            }
        }
    }
}

double shortest_by_trial(const Cell& cell, const Eigen::Vector3d& separation) {
    double shortest = separation.norm();
    for_each_image(cell, 12, [&](const Eigen::Vector3d& shift) { shortest = std::min(shortest, (separation + shift).norm()); });
    return shortest;
}

TEST(Cell, FindsTheShortestImageInAnyBox) {
    for (std::uint64_t number = 0; number < 40; ++number) {
        const Cell cell = random_cell(number, number < 20 ? 0.5 : 3.0, boundaries.at(number % boundaries.size()));
        for (std::uint64_t k = 0; k < 10; ++k) {
            const Eigen::Vector3d separation = 5 * (2 * uniform(4 + number, k) - Eigen::Vector3d::Ones());
            const Eigen::Vector3d image = cell.minimum_image(separation);
            EXPECT_NEAR(image.norm(), shortest_by_trial(cell, separation), 1e-12) << "box " << number;
            const Eigen::Vector3d turns = cell.in_edges(image - separation);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(turns[axis], cell.is_periodic(axis) ? std::round(turns[axis]) : 0.0, 1e-12);
            }
        }
    }
}

TEST(Cell, WrapsIntoAnyBox) {
    for (std::uint64_t number = 0; number < 40; ++number) {
        const Cell cell = random_cell(number, 2.0, boundaries.at(number % boundaries.size()));
        for (std::uint64_t k = 0; k < 10; ++k) {
            const Eigen::Vector3d position = 20 * (2 * uniform(60 + number, k) - Eigen::Vector3d::Ones());
            const Eigen::Vector3d wrapped = cell.wrap(position);
            const Eigen::Vector3d inside = cell.fraction(wrapped);
            const Eigen::Vector3d turns = cell.in_edges(wrapped - position);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(turns[axis], cell.is_periodic(axis) ? std::round(turns[axis]) : 0.0, 1e-10);
                EXPECT_TRUE(!cell.is_periodic(axis) || (inside[axis] >= 0 && inside[axis] < 1)) << inside[axis];
            }
            EXPECT_LT((cell.place(inside) - wrapped).norm(), 1e-12);
        }
    }
}

TEST(Cell, HasTheSameLatticeWhenReduced) {
    for (std::uint64_t number = 0; number < 40; ++number) {
        const Cell cell = random_cell(number, 4.0, boundaries.at(number % boundaries.size()));
        const Cell reduced = cell.reduced();
        EXPECT_NEAR(reduced.volume(), cell.volume(), 1e-12 * cell.volume());
        double shortest = std::numeric_limits<double>::infinity();
        for_each_image(cell, 25, [&](const Eigen::Vector3d& shift) {
            shortest = shift.norm() > 0 ? std::min(shortest, shift.norm()) : shortest;
        });
        if (cell.is_open()) {
            EXPECT_EQ(cell.half_period(), shortest);
        } else {
            EXPECT_NEAR(2 * cell.half_period(), shortest, 1e-12 * shortest);
        }
        EXPECT_EQ(reduced.half_period(), cell.half_period());
        for (int edge = 0; edge < 3; ++edge) {
            const Eigen::Vector3d multiples = cell.in_edges(reduced.edges().col(edge));
            EXPECT_TRUE(!cell.is_periodic(edge) || (multiples - multiples.array().round().matrix()).norm() < 1e-10);
        }
    }
}

TEST(Cell, RefusesEdgesWithoutAVolume) {
    const std::array<bool, 3> periodic = {true, true, true};
    Eigen::Matrix3d edges = Eigen::Matrix3d::Identity();
    edges.col(2) = edges.col(0) + edges.col(1);
    EXPECT_THROW(Cell::of_edges(Eigen::Vector3d::Zero(), edges, periodic), std::invalid_argument);
    edges(0, 2) = std::nan("");
    EXPECT_THROW(Cell::of_edges(Eigen::Vector3d::Zero(), edges, periodic), std::invalid_argument);
    EXPECT_THROW(random_cell(0, 0.5, periodic).lengths(), std::invalid_argument);
}

TEST(CellList, MeetsAllImagesInAnyBox) {
    constexpr Index particles = 40;
    for (std::uint64_t number = 0; number < 20; ++number) {
        const Cell cell = random_cell(number, 1.5, boundaries.at(number % boundaries.size()));
        Eigen::Matrix3Xd positions(3, particles);
        for (Index i = 0; i < particles; ++i) {
            positions.col(i) = cell.place(uniform(200 + number, static_cast<std::uint64_t>(i)));
        }
        const double cutoff = number % 2 == 0 ? 0.4 : 1.4;
        const CellList cells(cell, positions, cutoff);
        for (Index i = 0; i < particles; ++i) {
            Index met = 0;
            double sum = 0;
            cells.for_each_near(positions.col(i), [&](int, const Eigen::Vector3d& separation) {
                met += separation.norm() < cutoff ? 1 : 0;
                sum += separation.norm() < cutoff ? separation.norm() : 0.0;
            });
            Index expected = 0;
            double expected_sum = 0;
            for (Index j = 0; j < particles; ++j) {
                for_each_image(cell, 8, [&](const Eigen::Vector3d& shift) {
                    const double distance = (positions.col(j) + shift - positions.col(i)).norm();
                    expected += distance < cutoff ? 1 : 0;
                    expected_sum += distance < cutoff ? distance : 0.0;
                });
            }
            EXPECT_EQ(met, expected) << "box " << number;
            EXPECT_NEAR(sum, expected_sum, 1e-9);
        }
    }
}

}  // namespace
}  // namespace coagula
