// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/covering_spheres.hpp>

#include <coagula/common/cell_list.hpp>
#include <coagula/common/random.hpp>

#include "coverage_curve.hpp"
#include "pores_of_diagram.hpp"
#include "sample/sample_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace coagula::characterize {

namespace {

/// Empty spheres about the vertices of the diagram, which touch four particles.
struct EmptySpheres {
    Eigen::Matrix3Xd centres;
    Eigen::VectorXd radii;
};

EmptySpheres empty_spheres(const ReducedDiagram& reduced) {
    const double radius = reduced.diagram.radii[0];
    const Cell& cell = reduced.packing.cell;
    std::vector<Eigen::Vector3d> centres;
    std::vector<double> radii;
    for (const DiagramEdge& edge : reduced.diagram.edges) {
        const EdgeGeometry geometry = measure_edge(reduced.diagram, edge);
        for (std::size_t which = 0; which < 2; ++which) {
            const double power = geometry.end_power(which);
            const bool first_met = edge.apex[which] > *std::max_element(edge.around.begin(), edge.around.end());
            if (geometry.relative_volume[which] > well_conditioned && power > 0 && first_met) {
                centres.push_back(cell.wrap(geometry.end[which] + cell.origin()));
                radii.push_back(power / (std::sqrt(radius * radius + power) + radius));
            }
        }
    }
    const auto count = std::ssize(radii);
    return {Eigen::Map<const Eigen::Matrix3Xd>(centres.front().data(), 3, count),
            Eigen::Map<const Eigen::VectorXd>(radii.data(), count)};
}

/// What one point found.
struct Covered {
    double radius = -1;  ///< of the sphere; negative: the point does not count
    int particle = -1;   ///< nearest
};

class Sampler {
public:
    Sampler(const ReducedDiagram& reduced, const CoveringOptions& options)
        : packing_(reduced.packing),
          options_(options),
          largest_(largest_pore(reduced)),
          spheres_(empty_spheres(reduced)),
          particles_(packing_.cell, packing_.positions, 2 * largest_ + packing_.radii[0]),
          pores_(packing_.cell, spheres_.centres, largest_),
          window_(sample_window(packing_)) {}

    double largest() const { return largest_; }

    Covered at(Index number) const {
        const Eigen::Vector3d uniform =
            random_uniform(options_.seed, RandomPurpose::gelb_gubbins_sample, 0, static_cast<std::uint64_t>(number));
        const Eigen::Vector3d point = packing_.cell.place(uniform);
        const double radius = packing_.radii[0];
        if (window_.depth_at(point) < 2 * largest_ + radius) {
            return {};
        }
        Covered covered;
        double nearest = std::numeric_limits<double>::infinity();
        std::vector<Eigen::Vector3d> near;
        particles_.for_each_near(point, [&](int particle, const Eigen::Vector3d& separation) {
            const double distance = separation.norm() - radius;
            if (distance < nearest) {
                nearest = distance;
                covered.particle = particle;
            }
            if (distance < 2 * largest_) {
                near.push_back(separation);
            }
        });
        if (!(nearest > 0)) {
            return {};
        }
        const double known = std::min(largest_, std::max(nearest, largest_with_inside(point)));
        const auto count = std::ssize(near);
        const Eigen::Matrix3Xd centres = count > 0
                                             ? Eigen::Matrix3Xd(Eigen::Map<const Eigen::Matrix3Xd>(near.front().data(), 3, count))
                                             : Eigen::Matrix3Xd(3, 0);
        covered.radius = largest_touching_sphere(centres, Eigen::VectorXd::Constant(count, radius), largest_, known);
        return covered;
    }

private:
    double largest_with_inside(const Eigen::Vector3d& point) const {
        double radius = 0;
        pores_.for_each_near(point, [&](int sphere, const Eigen::Vector3d& separation) {
            if (separation.squaredNorm() <= spheres_.radii[sphere] * spheres_.radii[sphere]) {
                radius = std::max(radius, spheres_.radii[sphere]);
            }
        });
        return radius;
    }

    const Packing& packing_;
    const CoveringOptions& options_;
    double largest_;
    EmptySpheres spheres_;
    CellList particles_;
    CellList pores_;
    SampleWindow window_;
};

/// Number of points, sums of R and R^2, and numbers beyond each radius; by block, of points whose nearest particle has one.
Eigen::MatrixXd sum_points(const std::vector<Covered>& points, const Eigen::VectorXd& radius, const Blocks& blocks) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3 + radius.size(), std::max<Index>(blocks.count, 1));
    for (const Covered& point : points) {
        const int block = blocks.count > 0 && point.radius >= 0 ? blocks.of_particle[point.particle] : 0;
        if (point.radius < 0 || block < 0) {
            continue;
        }
        sums.col(block).head<3>() += Eigen::Vector3d(1, point.radius, point.radius * point.radius);
        const auto below = std::lower_bound(radius.begin(), radius.end(), point.radius) - radius.begin();
        sums.col(block).segment(3, below).array() += 1;
    }
    return sums;
}

/// Mean, standard deviation, and the curve.
Eigen::VectorXd estimates(const Eigen::VectorXd& sum) {
    Eigen::VectorXd found(sum.size() - 1);
    const double mean = sum[1] / sum[0];
    found << mean, std::sqrt(std::max(0.0, sum[2] / sum[0] - mean * mean)), sum.tail(sum.size() - 3) / sum[0];
    return found;
}

}  // namespace

CoveringSpheres measure_covering_spheres(const ReducedDiagram& reduced, const CoveringOptions& options, const Blocks& blocks,
                                         const Progress& progress) {
    require(is_monodisperse(reduced.packing),
            "the spheres are unequal, and the largest sphere that covers a point is found among equal ones only");
    require(options.points > 0 && options.radii >= 2, "covering spheres need at least one point and two radii");
    require_inner(reduced);
    progress.update("covering spheres", 0);
    const Sampler sampler(reduced, options);
    std::vector<Covered> points(static_cast<std::size_t>(options.points));
#pragma omp parallel for schedule(dynamic, 64)
    for (Index number = 0; number < options.points; ++number) {
        points[static_cast<std::size_t>(number)] = sampler.at(number);
    }
    const Eigen::VectorXd radius = Eigen::VectorXd::LinSpaced(options.radii, 0, sampler.largest());
    const Eigen::MatrixXd sums = sum_points(points, radius, blocks);
    const Eigen::VectorXd total = sums.rowwise().sum();
    require(total[0] > 0, reduced.packing.cell.is_periodic()
                              ? "none of the " + std::to_string(options.points) + " random points lies in the void"
                              : "the packing has a free surface, and none of the " + std::to_string(options.points) +
                                    " random points lies so far inside that the sphere which covers it is certain");
    const Eigen::VectorXd found = estimates(total);
    const Eigen::VectorXd errors = block_errors(sums, estimates);
    const double unit = reduced.unit;
    const auto count = static_cast<Index>(total[0]);
    return {.radius = unit * radius,
            .exceeding = found.tail(options.radii),
            .exceeding_stderr = errors.tail(options.radii),
            .mean = unit * found[0],
            .mean_stderr = unit * errors[0],
            .spread = unit * found[1],
            .spread_stderr = unit * errors[1],
            .sampling_error = unit * found[1] / std::sqrt(total[0]),
            .points = count};
}

CoveringSpheres measure_covering_spheres(const Packing& packing, const CoveringOptions& options, const Progress& progress) {
    check(packing);
    const ReducedDiagram reduced = reduced_diagram(packing);
    return measure_covering_spheres(reduced, options, make_blocks(packing, reduced.inner()), progress);
}

}  // namespace coagula::characterize
