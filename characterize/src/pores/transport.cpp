// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/transport.hpp>

#include <coagula/characterize/minkowski.hpp>
#include <coagula/common/parallel.hpp>

#include "geodesic.hpp"
#include "geometry/reduced_diagram.hpp"
#include "pore_conduction.hpp"

#include <limits>

namespace coagula::characterize {

namespace {

constexpr const char* transport_stage = "transport";

/// What one grid says, by axis.
struct OnGrid {
    Eigen::Array3d conductivity;
    Eigen::Array3d slope;  ///< of the conductivity as all spheres grow
    Eigen::Array3d tortuosity;
};

OnGrid measure_on(const Packing& packing, const VoxelGrid& grid, const Progress& progress, double begin, double end) {
    constexpr double tolerance = 1e-4;  // of the power 1e-8, of its slope some 1e-6: far below the error of the grid
    const double growth = 0.02 * grid.edge.minCoeff();
    const std::vector<double> corners = surface_distances(packing, grid, 0);
    const FaceConductances conductances = face_conductances(grid, open_faces(grid, corners));
    const FaceConductances grown = face_conductances(grid, open_faces(grid, corners, growth));
    const ConductionSolver solver(conductances);
    const double volume = packing.cell.volume();
    OnGrid found;
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = grid.edge[axis];
        const Eigen::ArrayXf potential = solver.solve(axis, spacing, tolerance);
        const double power = ConductionSolver::power(conductances, potential, axis, spacing);
        // The power is a minimum: its derivative is that at the potential as it is.
        found.conductivity[axis] = power / volume;
        found.slope[axis] = (ConductionSolver::power(grown, potential, axis, spacing) - power) / (growth * volume);
        progress.update(transport_stage, begin + (end - begin) * (axis + 1) / 4);
    }
    const std::vector<double> middles = surface_distances(packing, grid, 0.5);
    run_together(3, [&](std::size_t axis) {
        found.tortuosity[static_cast<Index>(axis)] = geodesic_tortuosity(grid, middles, static_cast<int>(axis));
    });
    progress.update(transport_stage, end);
    return found;
}

/// @param ratio of the voxels of the coarse grid to those of the fine one. @param order of the method in the size of a voxel.
/// @param least of any pores.
DirectionalValue directional(const Eigen::Array3d& fine, const Eigen::Array3d& coarse, double ratio, double order, double least) {
    const Eigen::Array3d change = (fine - coarse) / (std::pow(ratio, order) - 1);
    const Eigen::Array3d found = fine + change;
    DirectionalValue value;
    value.by_axis = found.max(least);
    value.mean = value.by_axis.mean();
    value.at_bound = (found < least).any();
    value.grid_error = std::max(std::abs(change.mean()) / 2, value.mean - found.mean());
    value.axis_stderr = std::sqrt((value.by_axis.array() - value.mean).square().sum() / 6);
    return value;
}

/// Standard errors from the axes. @param lengths Johnson's Lambda along each axis [m].
void add_errors(const Eigen::Array3d& lengths, Transport& result) {
    const double factor = result.formation_factor.mean;
    const Eigen::Array3d permeabilities = lengths.square() / (8 * result.formation_factor.by_axis.array());
    const auto error = [](const Eigen::Array3d& values) { return std::sqrt((values - values.mean()).square().sum() / 6); };
    result.pore_length_stderr = error(lengths);
    result.permeability_stderr = error(permeabilities);
    result.diffusive_tortuosity_stderr = result.diffusive_tortuosity * result.formation_factor.axis_stderr / factor;
}

VoxelGrid finest_grid(const Packing& packing, const TransportOptions& options) {
    const double edge = std::max(1 / options.voxels_per_radius, std::cbrt(packing.cell.volume() / options.most_voxels));
    VoxelGrid grid = make_grid(packing, edge);
    require(grid.edge.maxCoeff() <= 1,
            "the packing would have voxels larger than its mean radius: transport needs more voxels than " +
                to_text(options.most_voxels));
    return grid;
}

}  // namespace

Transport measure_transport(const Packing& packing, const TransportOptions& options, const Progress& progress) {
    check(packing);
    require(packing.cell.is_periodic(), "transport is measured in periodic packings only, and this one has a free surface");
    require_between(options.voxels_per_radius, 0.99, 100.01, "the number of voxels per radius");
    require_between(options.most_voxels, 999, 1.000001e9, "the largest number of voxels");
    progress.update(transport_stage, 0);
    const double unit = mean_radius(packing);
    const Packing reduced = in_units_of(unit, packing);
    const Minkowski space = measure_minkowski(reduced, {.dilations = 2});
    const VoxelGrid fine = finest_grid(reduced, options);
    const VoxelGrid coarse = make_grid(reduced, 1.5 * std::cbrt(fine.edge.prod()));
    require((coarse.count < fine.count).all(), "the packing is too small for two grids of " + to_text(options.voxels_per_radius) +
                                                   " voxels per radius and fewer: more are needed");
    const OnGrid roughly = measure_on(reduced, coarse, progress, 0, 0.25);
    const OnGrid found = measure_on(reduced, fine, progress, 0.25, 1);
    constexpr double closed = 1e-9;
    require(found.conductivity.minCoeff() > closed && roughly.conductivity.minCoeff() > closed && found.tortuosity.allFinite() &&
                roughly.tortuosity.allFinite(),
            "the spheres leave no path through the pores that the voxels resolve: transport cannot be measured");
    require((found.slope < 0).all(),
            "the voxels are too coarse to see that the pores conduct less as the spheres grow: transport "
            "needs more voxels per radius");
    const double ratio = std::cbrt(coarse.edge.prod() / fine.edge.prod());
    Transport result;
    result.void_fraction = 1 - space.volume_fraction[0];
    // Straight pores conduct best (Wiener's bound), and no path around the box is shorter than the box.
    result.formation_factor =
        directional(found.conductivity.inverse(), roughly.conductivity.inverse(), ratio, 2, 1 / result.void_fraction);
    result.tortuosity = directional(found.tortuosity, roughly.tortuosity, ratio, 1, 1);
    result.diffusive_tortuosity = result.formation_factor.mean * result.void_fraction;
    result.pore_length = unit * -2 * found.conductivity.mean() / found.slope.mean();
    result.permeability = result.pore_length * result.pore_length / (8 * result.formation_factor.mean);
    add_errors(unit * -2 * found.conductivity / found.slope, result);
    const double surface = space.surface[0] / unit;
    result.permeability_kozeny_carman = std::pow(result.void_fraction, 3) / (5 * surface * surface);
    result.permeability_kozeny_carman_stderr = 2 * result.permeability_kozeny_carman * space.surface_stderr / space.surface[0];
    result.voxels = fine.count;
    result.voxels_per_radius = 1 / fine.edge.maxCoeff();
    return result;
}

}  // namespace coagula::characterize
