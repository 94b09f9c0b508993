// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/minkowski.hpp>

#include <coagula/common/parallel.hpp>

#include "geometry/facet_births.hpp"
#include "geometry/reduced_diagram.hpp"
#include "geometry/sphere_in_orthoscheme.hpp"
#include "sample/averaged_particles.hpp"

#include <boost/math/tools/roots.hpp>

namespace coagula::characterize {

namespace {

constexpr const char* functionals_stage = "Minkowski functionals";

/// Sums over the counted cells at each radius of a grid: columns are covered volume, area, mean curvature, Euler characteristic and
/// the volume of the cells, and their number.
enum Functional : Index { covered, area, curvature, euler, cells, particles, functionals };
using Sums = Eigen::Array<double, Eigen::Dynamic, functionals>;

/// The levels at which a diagram is measured: its balls have radius^2 = site radius^2 + level. Equal spheres may have any level,
/// unequal ones only 0.
struct Levels {
    Eigen::VectorXd level;  ///< ascending

    Index first_at_least(double birth) const {
        return std::lower_bound(level.data(), level.data() + level.size(), birth) - level.data();
    }
};

/// A share of a simplex that is there from a level on.
void add_simplex(const Levels& levels, double birth, double share, Sums& sums) {
    const Index first = levels.first_at_least(birth);
    if (first < sums.rows()) {
        sums(first, euler) += share;  // differences; summed up at the end
    }
}

/// The sums of up to two sites whose cells see the same tetrahedron at an edge.
using Viewers = std::array<Sums*, 2>;

void add_orthoscheme(const Levels& levels, double radius, double a, double b, double c, const Viewers& viewers) {
    const double weight = sign(a) * sign(b) * sign(c);
    if (weight == 0) {
        return;
    }
    const Orthoscheme tetrahedron(std::abs(a), std::abs(b), std::abs(c));
    const double whole = tetrahedron.a * tetrahedron.b * tetrahedron.c / 6;
    for (Index k = 0; k < levels.level.size(); ++k) {
        const double rho = std::sqrt(radius * radius + levels.level[k]);
        const SpherePart part = sphere_part(tetrahedron, rho);
        for (Sums* const sums : viewers) {
            if (sums != nullptr) {
                (*sums)(k, covered) += weight * part.volume;
                (*sums)(k, area) += weight * part.area;
                (*sums)(k, curvature) += weight * (part.area / rho - part.bend / 2);
                (*sums)(k, cells) += weight * whole;
            }
        }
    }
}

void add_edge(const PowerDiagram& diagram, const DiagramEdge& edge, const Levels& levels, const SpaceBlocks& block,
              std::vector<Sums>& blocks) {
    const EdgeGeometry geometry = measure_edge(diagram, edge);
    std::array<Sums*, 3> sums{};
    std::array<double, 3> radius{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const auto site = static_cast<std::size_t>(edge.around[corner]);
        sums[corner] = diagram.counted[site] == 0 ? nullptr : &blocks[static_cast<std::size_t>(block.of_particle[site])];
        radius[corner] = diagram.radii[edge.around[corner]];
    }
    const auto add = [&](double of_radius, double distance, double foot_distance, const Viewers& viewers) {
        if (viewers[0] != nullptr || viewers[1] != nullptr) {
            add_orthoscheme(levels, of_radius, distance, foot_distance, geometry.height[0], viewers);
            add_orthoscheme(levels, of_radius, distance, foot_distance, geometry.height[1], viewers);
        }
    };
    for (const EdgeSide& side : geometry.sides) {
        const auto first = static_cast<std::size_t>(side.first), second = static_cast<std::size_t>(side.second);
        if (radius[first] == radius[second]) {  // mirror images
            add(radius[first], side.first_distance, side.foot_distance, {sums[first], sums[second]});
        } else {
            add(radius[first], side.first_distance, side.foot_distance, {sums[first], nullptr});
            add(radius[second], side.second_distance, side.foot_distance, {sums[second], nullptr});
        }
    }
    for (Sums* const own : sums) {
        if (own != nullptr) {  // the triangle, and two tetrahedra that each corner sees from three triangles
            add_simplex(levels, edge_birth(geometry), 1.0 / 3, *own);
            add_simplex(levels, geometry.end_power(0), -1.0 / 12, *own);
            add_simplex(levels, geometry.end_power(1), -1.0 / 12, *own);
        }
    }
}

/// Particles whose cells are not empty, and pairs.
void add_small_simplices(const PowerDiagram& diagram, const Levels& levels, const SpaceBlocks& block, std::vector<Sums>& blocks) {
    const std::vector<FacetBirth> facets = facet_births(diagram);
    for (std::size_t first = 0; first < facets.size();) {
        const int site = facets[first].site;
        const double radius = diagram.radii[site];
        Sums& sums = blocks[static_cast<std::size_t>(block.of_particle[static_cast<std::size_t>(site)])];
        double birth = std::numeric_limits<double>::infinity();
        bool centre_inside = true;
        for (; first < facets.size() && facets[first].site == site; ++first) {
            add_simplex(levels, facets[first].birth, -0.5, sums);
            birth = std::min(birth, facets[first].birth);
            centre_inside = centre_inside && facets[first].signed_distance >= 0;
        }
        add_simplex(levels, centre_inside ? -radius * radius : birth, 1, sums);
        sums.col(particles) += 1;
    }
}

/// The functionals of each block of space. Edges are measured chunk by chunk and summed in order, so that the number of threads
/// does not matter.
std::vector<Sums> measure_diagram(const PowerDiagram& diagram, const Levels& levels, const SpaceBlocks& block) {
    constexpr std::size_t chunks = 64;
    const std::vector<Sums> none(static_cast<std::size_t>(block.count), Sums::Zero(levels.level.size(), functionals));
    std::vector<std::vector<Sums>> partial(chunks, none);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        for (std::size_t k = diagram.edges.size() * chunk / chunks; k < diagram.edges.size() * (chunk + 1) / chunks; ++k) {
            add_edge(diagram, diagram.edges[k], levels, block, partial[chunk]);
        }
    }
    std::vector<Sums> total = none;
    add_small_simplices(diagram, levels, block, total);
    for (const auto& part : partial) {
        for (std::size_t k = 0; k < total.size(); ++k) {
            total[k] += part[k];
        }
    }
    for (Sums& sums : total) {
        for (Index k = 1; k < sums.rows(); ++k) {
            sums(k, euler) += sums(k - 1, euler);
        }
    }
    return total;
}

double require_surface(double largest_power) {
    require(largest_power > 0, "the spheres cover all space: there is no surface to measure");
    return largest_power;
}

/// Growth of all radii at which the last void closes.
double largest_dilation(const Packing& packing, const PowerDiagram& diagram) {
    const double power = require_surface(largest_vertex_power(diagram));
    const double smallest = packing.radii.minCoeff();
    const double bound = power / (std::sqrt(smallest * smallest + power) + smallest);
    if (diagram.radii.maxCoeff() == diagram.radii.minCoeff()) {
        return bound;
    }
    const auto power_at = [&](double growth) {
        return largest_vertex_power(grown_diagram(packing, diagram, growth, diagram.margin));
    };
    double high = bound;
    double high_power = power_at(high);
    while (high_power > 0) {  // the cells of an open packing move with the growth
        high *= 1.1;
        high_power = power_at(high);
    }
    std::uintmax_t iterations = 50;
    return boost::math::tools::toms748_solve(power_at, 0.0, high, power, high_power, boost::math::tools::eps_tolerance<double>(20),
                                             iterations)
        .second;
}

/// Sums of each block at each dilation.
std::vector<Sums> measure_equal(const PowerDiagram& diagram, const Eigen::VectorXd& dilation, const SpaceBlocks& block) {
    const double radius = diagram.radii[0];
    const Levels levels{dilation.array() * (dilation.array() + 2 * radius)};
    return measure_diagram(diagram, levels, block);
}

std::vector<Sums> measure_unequal(const Packing& packing, const PowerDiagram& diagram, const Eigen::VectorXd& dilation,
                                  const SpaceBlocks& block, const Progress& progress) {
    std::vector<Sums> sums(static_cast<std::size_t>(block.count), Sums::Zero(dilation.size(), functionals));
    const Levels levels{Eigen::VectorXd::Zero(1)};
    constexpr Index batch = 8;
    for (Index first = 0; first < dilation.size(); first += batch) {
        const auto measure = [&](std::size_t place) {
            const Index k = first + static_cast<Index>(place);
            const auto found = measure_diagram(grown_diagram(packing, diagram, dilation[k], diagram.margin), levels, block);
            for (std::size_t one = 0; one < sums.size(); ++one) {
                sums[one].row(k) = found[one].row(0);
            }
        };
        run_together(static_cast<std::size_t>(std::min(batch, dilation.size() - first)), measure);
        progress.update(functionals_stage, static_cast<double>(first) / static_cast<double>(dilation.size()));
    }
    return sums;
}

double zero_of(const Eigen::VectorXd& curve, const Eigen::VectorXd& place) {
    if (curve[0] <= 0) {
        return 0;
    }
    for (Index k = 1; k < curve.size(); ++k) {
        if (curve[k] <= 0) {
            return place[k] + (place[k - 1] - place[k]) * curve[k] / (curve[k] - curve[k - 1]);
        }
    }
    return unset;
}

/// Blocks differ in their number of particles, but structures of the same kind and size do not: what follows the density of the
/// blocks is taken out by regression.
void add_standard_errors(const std::vector<Sums>& blocks, double unit, Minkowski& result) {
    Eigen::MatrixXd sums(static_cast<Index>(functionals), std::ssize(blocks));
    for (Index k = 0; k < sums.cols(); ++k) {
        sums.col(k) = blocks[static_cast<std::size_t>(k)].row(0).transpose();
    }
    const Eigen::VectorXd mean = sums.rowwise().sum() / sums.row(cells).sum();
    const Eigen::MatrixXd deviation = sums - mean * sums.row(cells);
    const Eigen::VectorXd excess = deviation.row(particles).transpose();
    const Eigen::Vector4d slope =
        excess.squaredNorm() > 0 ? Eigen::Vector4d(deviation.topRows(4) * excess / excess.squaredNorm()) : Eigen::Vector4d::Zero();
    const Eigen::VectorXd error = block_errors(sums, [&](const Eigen::VectorXd& sum) -> Eigen::VectorXd {
        return (sum.head(4) - slope * (sum[particles] - mean[particles] * sum[cells])) / sum[cells];
    });
    result.volume_fraction_stderr = error[covered];
    result.surface_stderr = error[area] / unit;
    result.mean_curvature_stderr = error[curvature] / (unit * unit);
    result.euler_characteristic_stderr = error[euler] / (unit * unit * unit);
}

/// Standard error of the dilation at which the Euler characteristic passes zero.
double percolation_error(const std::vector<Sums>& blocks, const Eigen::VectorXd& dilation) {
    const Index steps = dilation.size();
    Eigen::MatrixXd sums(steps + 2, std::ssize(blocks));
    for (Index k = 0; k < sums.cols(); ++k) {
        const Sums& block = blocks[static_cast<std::size_t>(k)];
        sums.col(k) << block.col(euler), block(0, particles), block(0, cells);
    }
    return block_errors(
        sums, [&](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, zero_of(sum.head(steps), dilation)); },
        [steps](const Eigen::VectorXd& sum) { return sum[steps] / sum[steps + 1]; })[0];
}

}  // namespace

Minkowski measure_minkowski(const Packing& packing, const MinkowskiOptions& options, const Progress& progress) {
    check(packing);
    require(options.dilations == 0 || options.dilations >= 2, "the Minkowski functionals need at least 2 dilations");
    progress.update(functionals_stage, 0);
    const bool equal = is_monodisperse(packing);
    const ReducedDiagram base = reduced_diagram(packing);
    require_inner(base);
    const double unit = base.unit;
    const Packing& reduced = base.packing;
    const PowerDiagram& diagram = base.diagram;
    const SpaceBlocks block = space_blocks(packing);
    const Index steps = options.dilations > 0 ? options.dilations : (equal ? 60 : 20);
    const Eigen::VectorXd dilation = Eigen::VectorXd::LinSpaced(steps, 0, largest_dilation(reduced, diagram));
    const std::vector<Sums> blocks =
        equal ? measure_equal(diagram, dilation, block) : measure_unequal(reduced, diagram, dilation, block, progress);
    Sums total = Sums::Zero(steps, functionals);
    for (const Sums& sums : blocks) {
        total += sums;
    }
    const Eigen::ArrayXd volume = total.col(cells);
    Minkowski result;
    result.dilation = unit * dilation;
    result.volume_fraction = total.col(covered) / volume;
    result.surface = (total.col(area) / volume / unit).max(0.0);  // where all is covered, rounding leaves a little of either sign
    result.mean_curvature = total.col(curvature) / volume / (unit * unit);
    result.euler_characteristic = total.col(euler) / volume / (unit * unit * unit);
    result.inner_particles = base.inner_count();
    result.volume = volume[0] * unit * unit * unit;
    result.percolation_dilation = zero_of(result.euler_characteristic, result.dilation);
    result.percolation_dilation_stderr = unit * percolation_error(blocks, dilation);
    add_standard_errors(blocks, unit, result);
    progress.update(functionals_stage, 1);
    return result;
}

}  // namespace coagula::characterize
