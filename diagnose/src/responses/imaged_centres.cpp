// SPDX-License-Identifier: GPL-3.0-or-later
#include "imaged_centres.hpp"

#include "interpolation.hpp"
#include "observables/neighbour_shells.hpp"
#include "observables/repeated_images.hpp"
#include "structure_changes.hpp"

#include <vector>

namespace coagula::diagnose {

namespace {

/// Standard deviation over the diameter; below, no shell notices it.
constexpr NodeAxis error_axis{0.02, 0.9, 9};

/// Neighbours in every shell for errors in the plane and along z over the diameter.
const std::vector<double>& shells(Simulator& simulator, double plane, double axis) {
    return simulator.remembered({"neighbours by direction", 0, {plane, axis}}, [&] {
        const double diameter = 2 * simulator.radius();
        return simulator.mean_over_structures("neighbours by direction", shell_count, {plane, axis}, [&](const Packing& structure) {
            return shells_of_structure(structure, diameter * plane, diameter * axis);
        });
    });
}

/// Scatter of the neighbour counts by direction, averaged over the structures.
const std::vector<double>& neighbour_spread(Simulator& simulator) {
    constexpr std::size_t count = shell_count;
    return simulator.remembered({"spread of neighbours by direction"}, [&] {
        return simulator.mean_over_structures("spread of neighbours by direction", count * (1 + 2 * count), {},
                                              spread_of_neighbours);
    });
}

/// Neighbour counts about free points by direction, averaged over the structures.
const std::vector<double>& shells_about_places(Simulator& simulator) {
    return simulator.remembered({"places by direction"}, [&] {
        return simulator.mean_over_structures("places by direction", shell_count + 1, {}, shells_about_free_places);
    });
}

/// Apparent over true standard deviations, and the share of the centres that are in both images but are not matched.
const std::vector<double>& matched_images(Simulator& simulator, double plane, double axis) {
    return simulator.remembered({"images", 0, {plane, axis}}, [&] {
        const double diameter = 2 * simulator.radius();
        return simulator.mean_over_structures("images", 3, {plane, axis}, [&](const Packing& structure) -> std::vector<double> {
            const auto seen = images_of_structure(structure, diameter * plane, diameter * axis).values;
            return {seen[0] / plane, seen[1] / axis, seen[2]};
        });
    });
}

}  // namespace

Eigen::MatrixXd neighbour_errors_of_structures(Simulator& simulator) {
    const double particles = simulator.particles() * static_cast<double>(simulator.structures());
    return errors_of_structures(neighbour_spread(simulator), particles);
}

Eigen::MatrixXd neighbour_errors_of_image(Simulator& simulator, double centres, double mutual) {
    return errors_of_density(neighbour_spread(simulator), centres, mutual);
}

std::array<double, 3> repeated_images(Simulator& simulator, const Settings& settings, bool exact) {
    const double plane = settings.localisation_plane / (2 * simulator.radius());
    const double axis = settings.localisation_axis / (2 * simulator.radius());
    std::vector<double> seen{1, 1, 0};
    if (exact && plane > 0 && axis > 0) {
        seen = matched_images(simulator, plane, axis);
    } else if (plane > 0 || axis > 0) {
        for (std::size_t entry = 0; entry < seen.size(); ++entry) {
            seen[entry] = interpolate_nodes(error_axis, plane, axis, [&](int i, int j) {
                return matched_images(simulator, error_axis.node(i), error_axis.node(j))[entry];
            });
        }
    }
    // A centre is a particle that the next image has, too. (In less than a hundredth of the centres it is a false one, and that
    // image happens to have something near.)
    return {plane * seen[0], axis * seen[1], 1 - (1 - settings.false_share) * (1 - settings.missed_share) * (1 - seen[2])};
}

double neighbours(Simulator& simulator, const Settings& settings, std::size_t shell, bool exact) {
    if (settings.structures != StructureChange{}) {
        return over_changes(simulator, settings.structures,
                            [&](Simulator& other) { return neighbours(other, as_stated(settings), shell); });
    }
    const double plane = settings.localisation_plane / (2 * simulator.radius());
    const double axis = settings.localisation_axis / (2 * simulator.radius());
    const auto at_node = [&](int i, int j) { return shells(simulator, error_axis.node(i), error_axis.node(j))[shell]; };
    const double pairs = exact || (plane == 0 && axis == 0) ? shells(simulator, plane, axis)[shell]
                                                            : interpolate_nodes(error_axis, plane, axis, at_node);
    const double found = 1 - settings.missed_share;
    if (settings.false_share == 0) {
        return found * pairs;
    }
    // Pairs of particles, of a particle and a false point seen from either, and of false points, which lie anywhere.
    const std::vector<double>& near = shells_about_places(simulator);
    const double share = settings.false_share;
    const double false_density = share / (1 - share) * near.back();
    return found * ((1 - share) * pairs + share * (2 * near[shell] + false_density * shell_volume(shell)));
}

}  // namespace coagula::diagnose
