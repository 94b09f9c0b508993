// What errors of localisation do to the neighbours of a particle: structures with errors at the nodes of a grid.
#include <coagula/diagnose/simulator.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"
#include "observables/neighbour_shells.hpp"
#include "observables/repeated_images.hpp"

namespace coagula::diagnose {

namespace {

/// Standard deviation over the diameter; below, no shell notices it.
constexpr Axis error_axis{0.02, 0.9, 9};

}  // namespace

/// So many numbers that are measured of every structure at a place, from the cache where they are known: mean over the structures.
std::vector<double> Simulator::mean_over_structures(const std::string& what, std::size_t count, const std::vector<double>& place,
                                                    const std::function<std::vector<double>(const Packing&)>& measure) {
    std::vector<double> mean(count, 0.0);
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::string key = key_of(what + " " + names_[k], place);
        auto found = find_result(cache_, key, count);
        if (found == cache_.end()) {
            found = cache_.insert_or_assign(key, measure(structures_[k])).first;
        }
        for (std::size_t entry = 0; entry < mean.size(); ++entry) {
            mean[entry] += found->second[entry] / static_cast<double>(structures_.size());
        }
    }
    return mean;
}

/// Neighbours in every shell for errors in the plane and along z over the diameter.
std::vector<double> Simulator::shells(double plane, double axis) {
    return mean_over_structures("neighbours by direction", shell_count, {plane, axis}, [&](const Packing& structure) {
        return shells_of_structure(structure, 2 * radius_ * plane, 2 * radius_ * axis);
    });
}

/// Scatter of the neighbour counts by direction, averaged over the structures.
const std::vector<double>& Simulator::neighbour_spread() {
    if (spread_of_neighbours_.empty()) {
        constexpr std::size_t shells = shell_count;
        constexpr std::size_t count = shells * (1 + 2 * shells);
        spread_of_neighbours_ = mean_over_structures("spread of neighbours by direction", count, {}, spread_of_neighbours);
    }
    return spread_of_neighbours_;
}

Eigen::MatrixXd Simulator::neighbour_errors_of_structures() {
    double particles = 0;
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        particles += static_cast<double>(structures_.particles(k));
    }
    return errors_of_structures(neighbour_spread(), particles);
}

Eigen::MatrixXd Simulator::neighbour_errors_of_image(double centres, double mutual) {
    return errors_of_density(neighbour_spread(), centres, mutual);
}

const std::vector<double>& Simulator::shell_node(int plane, int axis) {
    std::vector<double>& node = shell_nodes_[{plane, axis}];
    if (node.empty()) {
        node = shells(error_axis.node(plane), error_axis.node(axis));
    }
    return node;
}

/// Neighbour counts about free points by direction, averaged over the structures.
const std::vector<double>& Simulator::shells_about_places() {
    if (shells_about_places_.empty()) {
        shells_about_places_ = mean_over_structures("places by direction", shell_count + 1, {}, shells_about_free_places);
    }
    return shells_about_places_;
}

/// Apparent over true standard deviations, and the share of the centres that are in both images but are not matched.
std::vector<double> Simulator::matched_images(double plane, double axis) {
    return mean_over_structures("images", 3, {plane, axis}, [&](const Packing& structure) -> std::vector<double> {
        const auto seen = images_of_structure(structure, 2 * radius_ * plane, 2 * radius_ * axis).values;
        return {seen[0] / plane, seen[1] / axis, seen[2]};
    });
}

const std::vector<double>& Simulator::image_node(int plane, int axis) {
    std::vector<double>& node = image_nodes_[{plane, axis}];
    if (node.empty()) {
        node = matched_images(error_axis.node(plane), error_axis.node(axis));
    }
    return node;
}

std::array<double, 3> Simulator::repeated_images(const Settings& settings, bool exact) {
    const double plane = settings.localisation_plane / (2 * radius_);
    const double axis = settings.localisation_axis / (2 * radius_);
    std::vector<double> seen{1, 1, 0};
    if (exact && plane > 0 && axis > 0) {
        seen = matched_images(plane, axis);
    } else if (plane > 0 || axis > 0) {
        for (std::size_t entry = 0; entry < seen.size(); ++entry) {
            seen[entry] = interpolate_nodes(error_axis, plane, axis, [&](int i, int j) { return image_node(i, j)[entry]; });
        }
    }
    // A centre is a particle that the next image has, too. (In less than a hundredth of the centres it is a false one, and that
    // image happens to have something near.)
    return {plane * seen[0], axis * seen[1], 1 - (1 - settings.false_share) * (1 - settings.missed_share) * (1 - seen[2])};
}

double Simulator::neighbours(const Settings& settings, std::size_t shell, bool exact) {
    if (const StructureChange change = change_of(settings); change != StructureChange{}) {
        return over_changes(change, [&](Simulator& other) { return other.neighbours(as_stated(settings), shell); });
    }
    const double plane = settings.localisation_plane / (2 * radius_);
    const double axis = settings.localisation_axis / (2 * radius_);
    const double pairs = exact || (plane == 0 && axis == 0)
                             ? shells(plane, axis)[shell]
                             : interpolate_nodes(error_axis, plane, axis, [&](int i, int j) { return shell_node(i, j)[shell]; });
    const double found = 1 - settings.missed_share;
    if (settings.false_share == 0) {
        return found * pairs;
    }
    // Pairs of particles, of a particle and a false point seen from either, and of false points, which lie anywhere.
    const std::vector<double>& near = shells_about_places();
    const double share = settings.false_share;
    const double false_density = share / (1 - share) * near.back();
    return found * ((1 - share) * pairs + share * (2 * near[shell] + false_density * shell_volume(shell)));
}

}  // namespace coagula::diagnose
