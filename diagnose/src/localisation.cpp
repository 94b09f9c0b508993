// What errors of localisation do to the neighbours of a particle: structures with errors at the nodes of a grid.
#include <coagula/diagnose/simulator.hpp>

#include "cache_key.hpp"
#include "interpolation.hpp"
#include "neighbour_shells.hpp"

namespace coagula::diagnose {

namespace {

/// Standard deviation over the diameter; below, no shell notices it.
constexpr Axis error_axis{0.02, 0.9, 9};

}  // namespace

/// Neighbours in every shell, mean over the structures, for errors in the plane and along z over the diameter.
std::vector<double> Simulator::shells(double plane, double axis) {
    std::vector<double> mean(shell_count, 0.0);
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::string key = key_of("shells " + names_[k], {plane, axis});
        auto found = cache_.find(key);
        if (found == cache_.end()) {
            found = cache_.emplace(key, shells_of_structure(structures_[k], 2 * radius_ * plane, 2 * radius_ * axis)).first;
        }
        for (std::size_t shell = 0; shell < mean.size(); ++shell) {
            mean[shell] += found->second[shell] / static_cast<double>(structures_.size());
        }
    }
    return mean;
}

const std::vector<double>& Simulator::shell_node(int plane, int axis) {
    std::vector<double>& node = shell_nodes_[{plane, axis}];
    if (node.empty()) {
        node = shells(error_axis.node(plane), error_axis.node(axis));
    }
    return node;
}

double Simulator::neighbours(const Settings& settings, std::size_t shell, bool exact) {
    const double plane = settings.localisation_plane / (2 * radius_);
    const double axis = settings.localisation_axis / (2 * radius_);
    const double found = 1 - settings.missed_share;
    if (exact || (plane == 0 && axis == 0)) {
        return found * shells(plane, axis)[shell];
    }
    return found * interpolate_nodes(error_axis, plane, [&](int i) {
               return interpolate_nodes(error_axis, axis, [&](int j) { return shell_node(i, j)[shell]; });
           });
}

}  // namespace coagula::diagnose
