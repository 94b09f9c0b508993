// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/plausibility.hpp>

#include <coagula/common/cell_list.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/readable.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace coagula::characterize {

namespace {

constexpr double touching_tolerance = 0.01;
constexpr double largest_kissing_number = 12;
constexpr double limit_slack = 1e-3;  ///< of the two limits of equal spheres

// Limits beyond which spheres are no packing. Measured centres have errors of some per cent, and soft spheres overlap by some.
constexpr double largest_median = 1.1;
constexpr double least_median = 0.9;
constexpr double least_distance = 0.5;

/// The least reduced distance to a particle whose centre is within reach of the list.
double nearest_within(const Packing& packing, const CellList& cells, Index i) {
    double nearest = std::numeric_limits<double>::infinity();
    cells.for_each_near(packing.positions.col(i), [&](int j, const Eigen::Vector3d& separation) {
        const double distance = separation.norm();
        if (j != i || distance > 0) {
            nearest = std::min(nearest, distance / (packing.radii[i] + packing.radii[j]));
        }
    });
    return nearest;
}

double median_of(Eigen::VectorXd values) {
    const auto middle = values.begin() + values.size() / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool touches_its_own_image(const ContactNetwork& contacts) {
    return (contacts.ends.row(0).array() == contacts.ends.row(1).array()).any();
}

void warn_of_distances(Plausibility& found) {
    if (found.median > largest_median) {
        found.warnings.push_back("the spheres do not touch: the nearest centre is " + with_unit(found.median, "1") +
                                 " diameters away (median); check the length unit, the radius and the box");
    }
    if (found.median < least_median) {
        found.warnings.push_back("the spheres overlap too much for a packing: the nearest centre is " +
                                 with_unit(found.median, "1") + " diameters away (median); check the length unit and the radius");
    } else if (found.smallest < least_distance) {
        found.warnings.push_back("two centres are only " + with_unit(found.smallest, "1") +
                                 " diameters apart, such as those of a particle that was found twice");
    }
}

/// Limits that hold for equal spheres only.
void warn_of_density(Plausibility& found) {
    const double densest = std::numbers::pi / std::sqrt(18.0);
    if (found.volume_fraction > densest * (1 + limit_slack)) {
        found.warnings.push_back("the volume fraction is above " + with_unit(densest, "1") +
                                 ", that of the densest packing of equal spheres; check the length unit, the radius and the box");
    }
    if (found.coordination > largest_kissing_number * (1 + limit_slack)) {
        found.warnings.push_back(
            "a sphere has more than 12 contacts on average, more than equal spheres can have; check the radius");
    }
}

}  // namespace

Eigen::VectorXd nearest_reduced_distances(const Packing& packing) {
    const double largest_radius = packing.radii.maxCoeff();
    const double extent = (packing.positions.rowwise().maxCoeff() - packing.positions.rowwise().minCoeff()).norm() +
                          packing.cell.edge_lengths().norm();
    Eigen::VectorXd nearest(packing.size());
    std::vector<Index> pending(static_cast<std::size_t>(packing.size()));
    std::iota(pending.begin(), pending.end(), Index{0});
    // A small reach first, for those that touch: in a cluster within a large box a wide reach would hold nearly all particles.
    for (double reach = 2 * (1 + touching_tolerance) * largest_radius; !pending.empty(); reach *= 2) {
        const CellList cells(packing.cell, packing.positions, reach);
#pragma omp parallel for schedule(dynamic, 64)
        for (std::size_t k = 0; k < pending.size(); ++k) {
            nearest[pending[k]] = nearest_within(packing, cells, pending[k]);
        }
        std::erase_if(pending,
                      [&](Index i) { return nearest[i] * (packing.radii[i] + largest_radius) <= reach || reach > extent; });
    }
    return nearest;
}

Plausibility judge_plausibility(const Packing& packing) {
    Plausibility found;
    const ContactNetwork contacts = find_contacts(packing, touching_tolerance);
    found.volume_fraction = volume_fraction(packing);
    found.contacts = contacts.size();
    found.coordination = coordination_number(contacts);
    const Eigen::VectorXd nearest = nearest_reduced_distances(packing);
    if (!nearest.allFinite()) {
        return found;
    }
    found.smallest = nearest.minCoeff();
    found.median = median_of(nearest);
    warn_of_distances(found);
    if (is_monodisperse(packing)) {
        warn_of_density(found);
    }
    if (touches_its_own_image(contacts)) {
        found.warnings.push_back(
            "spheres touch their own images: the box is no wider than a sphere, as that of a two-dimensional packing");
    }
    return found;
}

}  // namespace coagula::characterize
