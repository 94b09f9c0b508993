// SPDX-License-Identifier: GPL-3.0-or-later
// Pore sizes by other definitions than Torquato's: free spheres, Delaunay pores, covering spheres.
#include <coagula/characterize/covering_spheres.hpp>
#include <coagula/characterize/delaunay_pores.hpp>
#include <coagula/characterize/free_spheres.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/image_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "pores/touching_sphere.hpp"
#include "test_packings.hpp"

namespace coagula::characterize {
namespace {

const Eigen::Vector3i cells(3, 3, 3);

/// Spheres put down at random one after the other where they do not overlap.
Packing sparse_spheres(Index particles, double edge, double smallest, double largest, std::uint64_t seed) {
    Packing packing = test::random_spheres(particles, Eigen::Vector3d::Constant(edge), smallest, largest, seed);
    for (Index i = 0; i < particles; ++i) {
        for (std::uint64_t step = 2;; ++step) {
            bool free = true;
            for (Index j = 0; j < i && free; ++j) {
                const Eigen::Vector3d way = packing.cell.minimum_image(packing.positions.col(j) - packing.positions.col(i));
                free = way.norm() > packing.radii[i] + packing.radii[j];
            }
            if (free) {
                break;
            }
            packing.positions.col(i) = edge * random_uniform(seed, RandomPurpose::test, step, static_cast<std::uint64_t>(i));
        }
    }
    return packing;
}

/// Distance from a point to the nearest surface; negative inside a sphere.
double surface_distance(const Packing& packing, const Eigen::Vector3d& point) {
    double nearest = 1e300;
    for (Index i = 0; i < packing.size(); ++i) {
        nearest = std::min(nearest, packing.cell.minimum_image(packing.positions.col(i) - point).norm() - packing.radii[i]);
    }
    return nearest;
}

TEST(FreeSpheres, OfLattices) {
    const double r = 0.7;
    const FreeSpheres simple = measure_free_spheres(test::simple_cubic(cells, r));
    EXPECT_NEAR(simple.included, 2 * (std::sqrt(3.0) - 1) * r, 1e-9);  // corner of the cube to its middle
    EXPECT_NEAR(simple.free, 2 * (std::sqrt(2.0) - 1) * r, 1e-9);      // through the faces
    EXPECT_NEAR(simple.included_along_free, simple.included, 1e-9);
    const FreeSpheres face = measure_free_spheres(test::face_centred(cells, r));
    EXPECT_NEAR(face.included, 2 * (std::sqrt(2.0) - 1) * r, 1e-9);  // octahedral void
    EXPECT_NEAR(face.free, 2 * (2 / std::sqrt(3.0) - 1) * r, 1e-9);  // through triangles of touching spheres
    const FreeSpheres body = measure_free_spheres(test::body_centred(cells, r));
    EXPECT_NEAR(body.included, 2 * (std::sqrt(5.0 / 3) - 1) * r, 1e-9);  // tetrahedral void
    EXPECT_NEAR(body.free, 2 * (std::sqrt(1.5) - 1) * r, 1e-9);
    EXPECT_NEAR(body.free_by_axis.maxCoeff() - body.free_by_axis.minCoeff(), 0, 1e-9);
}

/// Layers of touching squares with wide gaps between: free along two axes, narrow along the third.
TEST(FreeSpheres, DifferByAxis) {
    Packing packing = test::lattice({{0, 0, 0}}, 2, {4, 4, 4}, 1);
    packing.cell = Cell::periodic({8, 8, 16});
    packing.positions.row(2) *= 2;
    const FreeSpheres found = measure_free_spheres(packing);
    EXPECT_NEAR(found.free_by_axis[0], 2 * (std::sqrt(5.0) - 1), 1e-9);  // between pairs 2 apart in layers 4 apart
    EXPECT_NEAR(found.free_by_axis[1], 2 * (std::sqrt(5.0) - 1), 1e-9);
    EXPECT_NEAR(found.free_by_axis[2], 2 * (std::sqrt(2.0) - 1), 1e-9);
    EXPECT_EQ(found.free, found.free_by_axis.maxCoeff());
}

TEST(FreeSpheres, NoWayIsZero) {
    const Packing packing = test::simple_cubic(cells, 1);
    Packing swollen = packing;
    swollen.radii.setConstant(1.5);  // above sqrt(2), below sqrt(3): the voids are closed
    const FreeSpheres found = measure_free_spheres(swollen);
    EXPECT_EQ(found.free, 0);
    EXPECT_NEAR(found.included, 2 * (std::sqrt(3.0) - 1.5), 1e-9);
    EXPECT_TRUE(std::isnan(found.included_along_free));
}

/// A step on a periodic grid to a neighbour, and the box in which that lies.
struct GridStep {
    Eigen::Vector3i to;
    Eigen::Vector3i image;
};

/// @param k of the six neighbours.
GridStep step_from(const Eigen::Vector3i& home, int k, int points) {
    GridStep step{home, Eigen::Vector3i::Zero()};
    int& along = step.to[k / 2];
    along += k % 2 == 0 ? 1 : -1;
    step.image[k / 2] = along < 0 ? -1 : (along == points ? 1 : 0);
    step.to -= points * step.image;
    return step;
}

/// Least clearance on the widest way around the box along each axis, from points on a grid: within sqrt(3) / 2 of the spacing.
Eigen::Vector3d free_radii_on_grid(const Packing& packing, int points) {
    const auto total = static_cast<std::size_t>(points) * points * points;
    const double spacing = packing.cell.lengths()[0] / points;
    std::vector<std::pair<double, std::size_t>> order(total);
    std::vector<double> clearance(total);
    for (std::size_t place = 0; place < total; ++place) {
        const auto p = static_cast<int>(place);
        const Eigen::Vector3i steps(p % points, p / points % points, p / points / points);
        const Eigen::Vector3d point = spacing * steps.cast<double>();
        clearance[place] = surface_distance(packing, point);
        order[place] = {clearance[place], place};
    }
    std::sort(order.rbegin(), order.rend());
    ImageSets sets(static_cast<Index>(total));
    Eigen::Vector3d found = Eigen::Vector3d::Constant(-1);
    for (const auto& [value, place] : order) {
        const auto p = static_cast<int>(place);
        const Eigen::Vector3i home(p % points, p / points % points, p / points / points);
        for (int k = 0; k < 6; ++k) {
            const auto [next, image] = step_from(home, k, points);
            const int number = (next[2] * points + next[1]) * points + next[0];
            const auto other = static_cast<std::size_t>(number);
            if (clearance[other] >= value) {
                const Eigen::Vector3i winding = sets.join(place, other, image);
                for (int axis = 0; axis < 3; ++axis) {
                    found[axis] = winding[axis] != 0 && found[axis] < 0 ? value : found[axis];
                }
            }
        }
    }
    return found;
}

void expect_free_spheres_of_a_grid(const Packing& packing) {
    constexpr int points = 50;
    const FreeSpheres found = measure_free_spheres(packing);
    const Eigen::Vector3d grid = free_radii_on_grid(packing, points);
    const double spacing = 6.0 / points;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.free_by_axis[axis] / 2, grid[axis], std::sqrt(3.0) / 2 * spacing) << axis;
    }
    EXPECT_NEAR(found.included / 2, measure_pores(packing).max, 1e-9);
    EXPECT_GE(found.included_along_free, found.free);
    EXPECT_LE(found.included_along_free, found.included * (1 + 1e-12));
}

TEST(FreeSpheres, OfEqualSpheresAgreeWithAGrid) {
    expect_free_spheres_of_a_grid(sparse_spheres(15, 6, 1, 1, 4));
}

TEST(FreeSpheres, OfUnequalSpheresAgreeWithAGrid) {
    expect_free_spheres_of_a_grid(sparse_spheres(15, 6, 0.7, 1.3, 4));
}

/// Slightly unequal spheres are measured by another way than equal ones, and must give nearly the same.
TEST(FreeSpheres, OfNearlyEqualSpheresAreThoseOfEqualOnes) {
    const Packing equal = sparse_spheres(36, 8, 1, 1, 9);
    Packing unequal = equal;
    unequal.radii[3] += 1e-7;
    const FreeSpheres one = measure_free_spheres(equal);
    const FreeSpheres other = measure_free_spheres(unequal);
    EXPECT_NEAR(other.included, one.included, 1e-6);
    EXPECT_NEAR((other.free_by_axis - one.free_by_axis).norm(), 0, 1e-6);
    if (std::isfinite(other.included_along_free) && one.included_along_free == one.included) {
        EXPECT_NEAR(other.included_along_free, one.included_along_free, 1e-6);
    }
}

/// Means of the circumspheres (by volume) and throats, throats per particle.
Eigen::Vector3d delaunay_means(const DelaunayPores& pores) {
    const Eigen::VectorXd sums = pores.by_particle.rowwise().sum();
    return {sums[2] / sums[1], sums[5] / sums[4], sums[4] / sums[0]};
}

TEST(DelaunayPores, OfLattices) {
    const double r = 0.7;
    const Eigen::Vector3d simple = delaunay_means(measure_delaunay_pores(test::simple_cubic(cells, r)));
    EXPECT_NEAR(simple[0], (std::sqrt(3.0) - 1) * r, 1e-9);
    EXPECT_NEAR(simple[1], (std::sqrt(2.0) - 1) * r, 1e-9);
    const Eigen::Vector3d face = delaunay_means(measure_delaunay_pores(test::face_centred(cells, r)));
    // Octahedra fill two thirds; images of one octahedron may be cut into tetrahedra in different ways.
    EXPECT_NEAR(face[0], ((std::sqrt(1.5) - 1) / 3 + (std::sqrt(2.0) - 1) * 2 / 3) * r, 1e-3);
    EXPECT_NEAR(face[1], (2 / std::sqrt(3.0) - 1) * r, 1e-9);
    EXPECT_NEAR(face[2], 8, 1e-9);  // two tetrahedra a particle, all four faces of which are throats
    const Eigen::Vector3d body = delaunay_means(measure_delaunay_pores(test::body_centred(cells, r)));
    EXPECT_NEAR(body[0], (std::sqrt(5.0 / 3) - 1) * r, 1e-9);
    EXPECT_NEAR(body[1], (std::sqrt(1.5) - 1) * r, 1e-9);
    EXPECT_NEAR(body[2], 12, 1e-9);  // six tetrahedra a particle, all four faces of which are throats
}

/// The particles and their images around the box, the particles first.
Eigen::Matrix3Xd with_images(const Packing& packing) {
    const Index particles = packing.size();
    Eigen::Matrix3Xd points(3, 27 * particles);
    points.leftCols(particles) = packing.positions;
    Index column = particles;
    for (int k = 0; k < 27; ++k) {
        const Eigen::Vector3i periods(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const Eigen::Vector3d shift = periods.cast<double>();
        for (Index i = 0; i < particles && k != 13; ++i) {
            points.col(column++) = packing.positions.col(i) + shift.cwiseProduct(packing.cell.lengths());
        }
    }
    return points;
}

bool is_empty(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& centre, double radius) {
    return (points.colwise() - centre).colwise().squaredNorm().minCoeff() > radius * radius * (1 - 1e-9);
}

/// From a point to the others that are nearer than `reach`.
std::vector<Eigen::Vector3d> branches_from(const Eigen::Matrix3Xd& points, Index i, double reach) {
    std::vector<Eigen::Vector3d> near;
    for (Index j = 0; j < points.cols(); ++j) {
        if (j != i && (points.col(j) - points.col(i)).norm() < reach) {
            near.emplace_back(points.col(j) - points.col(i));
        }
    }
    return near;
}

/// By their definitions: spheres through four points without another inside, and through three about a centre in their plane.
TEST(DelaunayPores, AgreeWithAllTriplesAndQuadruples) {
    const double r = 0.4;
    const Packing packing = test::random_spheres(14, Eigen::Vector3d::Constant(4), r, r, 11);
    const Eigen::Matrix3Xd points = with_images(packing);
    const double reach = 2 * (measure_pores(packing).max + r);
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(7);
    for (Index i = 0; i < packing.size(); ++i) {
        const std::vector<Eigen::Vector3d> near = branches_from(points, i, reach);
        const Eigen::Vector3d home = points.col(i);
        for (std::size_t a = 0; a < near.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const double aa = near[a].squaredNorm();
                const double bb = near[b].squaredNorm();
                const Eigen::Vector3d normal = near[a].cross(near[b]);
                const Eigen::Vector3d foot = (aa * near[b].cross(normal) + bb * normal.cross(near[a])) / (2 * normal.squaredNorm());
                if (foot.norm() < reach / 2 && is_empty(points, home + foot, foot.norm())) {
                    const double t = foot.norm() - r;
                    sums.tail(3) += Eigen::Vector3d(1, t, t * t) / 3;
                }
                for (std::size_t c = 0; c < b; ++c) {
                    Eigen::Matrix3d edges;
                    edges << near[a].transpose(), near[b].transpose(), near[c].transpose();
                    const Eigen::Vector3d centre = edges.partialPivLu().solve(0.5 * Eigen::Vector3d(aa, bb, near[c].squaredNorm()));
                    if (centre.norm() < reach / 2 * (1 + 1e-9) && is_empty(points, home + centre, centre.norm())) {
                        const double radius = centre.norm() - r;
                        sums.segment<3>(1) += std::abs(edges.determinant()) / 24 * Eigen::Vector3d(1, radius, radius * radius);
                    }
                }
            }
        }
    }
    sums[0] = 14;
    const Eigen::VectorXd found = measure_delaunay_pores(packing).by_particle.rowwise().sum();
    for (Index row = 0; row < 7; ++row) {
        EXPECT_NEAR(found[row], sums[row], 1e-7 * std::abs(sums[row])) << row;
    }
    EXPECT_NEAR(found[1], 64, 1e-9);
}

TEST(DelaunayPores, RefuseUnequalSpheres) {
    EXPECT_THROW(measure_delaunay_pores(sparse_spheres(28, 8, 0.8, 1.2, 1)), std::invalid_argument);
}

TEST(TouchingSphere, IsNoSmallerThanThatOfAnyDirection) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const Packing packing = sparse_spheres(20, 6, 0.6, 1.1, seed);
        const Eigen::Matrix3Xd points = with_images(packing);
        Eigen::Vector3d point = Eigen::Vector3d::Constant(3);
        for (std::uint64_t step = 1000; surface_distance(packing, point) < 0.02; ++step) {
            point = 6 * random_uniform(seed, RandomPurpose::test, step, 0);
        }
        const Eigen::Matrix3Xd ways = points.colwise() - point;
        const Eigen::VectorXd radii = packing.radii.replicate(27, 1);
        const double largest = 3;
        const double found = largest_touching_sphere(ways, radii, largest, 1e-6);
        double best = 0;
        for (std::uint64_t direction = 0; direction < 20000; ++direction) {
            const Eigen::Vector3d w = random_normal(seed, RandomPurpose::test, 7, direction).normalized();
            double radius = largest;
            for (Index i = 0; i < ways.cols(); ++i) {
                const double facing = radii[i] + w.dot(ways.col(i));
                if (facing > 0) {
                    radius = std::min(radius, (ways.col(i).squaredNorm() - radii[i] * radii[i]) / (2 * facing));
                }
            }
            best = std::max(best, radius);
        }
        EXPECT_LE(best, found * (1 + 1e-9)) << seed;
        EXPECT_GT(best, 0.93 * found) << seed;
    }
}

/// The spheres in the middles of the cubes cover a known part of the void.
TEST(CoveringSpheres, OfASimpleCubicLattice) {
    const double largest = std::sqrt(3.0) - 1;
    const CoveringSpheres found = measure_covering_spheres(test::simple_cubic({4, 4, 4}, 1), {.points = 20000, .radii = 50});
    const double share = std::pow(largest, 3) / (6 / std::numbers::pi - 1);
    const double error = std::sqrt(share * (1 - share) / static_cast<double>(found.points));
    EXPECT_NEAR(found.radius[49], largest, 1e-9);
    EXPECT_NEAR(found.exceeding[48], share, 4 * error + 0.012);  // the curve ends one step below the largest radius
    EXPECT_GE(found.exceeding[48], share - 4 * error);
    EXPECT_EQ(found.exceeding[0], 1);
}

/// At each point the largest sphere of those about the points of a grid that covers it: smaller by a little more than the spacing.
TEST(CoveringSpheres, AgreeWithAGridOfCentres) {
    const Packing packing = sparse_spheres(15, 6, 1, 1, 3);
    constexpr int along = 60;
    constexpr double spacing = 6.0 / along;
    std::vector<std::pair<double, Eigen::Vector3d>> centres;
    for (int k = 0; k < along * along * along; ++k) {
        const Eigen::Vector3i steps(k % along, k / along % along, k / along / along);
        const Eigen::Vector3d centre = spacing * steps.cast<double>();
        if (const double radius = surface_distance(packing, centre); radius > 0) {
            centres.emplace_back(radius, centre);
        }
    }
    const CoveringOptions options{.points = 400, .seed = 5};
    double sum = 0;
    Index points = 0;
    for (std::uint64_t number = 0; number < 400; ++number) {
        const Eigen::Vector3d point = 6 * random_uniform(5, RandomPurpose::gelb_gubbins_sample, 0, number);
        double best = surface_distance(packing, point);
        if (best <= 0) {
            continue;
        }
        for (const auto& [radius, centre] : centres) {
            if (radius > best && packing.cell.minimum_image(centre - point).norm() <= radius) {
                best = radius;
            }
        }
        sum += best;
        ++points;
    }
    const CoveringSpheres found = measure_covering_spheres(packing, options);
    ASSERT_EQ(found.points, points);
    const double grid = sum / static_cast<double>(points);
    EXPECT_GE(found.mean, grid * (1 - 1e-9));
    EXPECT_LE(found.mean, grid + std::sqrt(3.0) * spacing);
    EXPECT_GT(found.mean, measure_pores(packing).mean);
}

TEST(CoveringSpheres, OfAnOpenPackingComeFromItsMiddle) {
    const Packing packing = test::reference_structure("vem_1-2");
    Packing open = packing;
    open.cell = Cell::open(Eigen::Vector3d::Zero(), packing.cell.lengths());
    const CoveringSpheres inner = measure_covering_spheres(open, {.points = 4000});
    const CoveringSpheres all = measure_covering_spheres(packing, {.points = 4000});
    EXPECT_LT(inner.points, all.points / 2);
    EXPECT_NEAR(inner.mean, all.mean, 5 * std::hypot(inner.mean_stderr, all.mean_stderr));
    EXPECT_THROW(measure_covering_spheres(sparse_spheres(28, 8, 0.8, 1.2, 1)), std::invalid_argument);
}

TEST(TouchingSphereOfFour, TouchesAllOfThem) {
    Eigen::Matrix<double, 3, 4> centres;
    centres << 0, 3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3;
    const Eigen::Vector4d radii(0.5, 1, 0.7, 0.2);
    const auto ball = touching_sphere<3>(centres, radii);
    ASSERT_TRUE(ball.has_value());
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR((ball->centre - centres.col(k)).norm(), radii[k] + ball->radius, 1e-12);
    }
}

}  // namespace
}  // namespace coagula::characterize
