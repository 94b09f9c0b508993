// SPDX-License-Identifier: GPL-3.0-or-later
#include "thinned.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

namespace coagula::report {

namespace {

/// Distance from the middle of the cell along each edge over its length, the largest of the three: 1/2 at the faces.
Eigen::VectorXd distance_from_middle(const Cell& cell, const Eigen::Matrix3Xd& points) {
    Eigen::VectorXd distance(points.cols());
    for (Index point = 0; point < points.cols(); ++point) {
        distance[point] = cell.in_edges(points.col(point) - cell.centre()).cwiseAbs().maxCoeff();
    }
    return distance;
}

/// The numbers of the `most` smallest values, ascending.
std::vector<Index> numbers_of_smallest(const Eigen::VectorXd& values, Index most) {
    std::vector<Index> order(static_cast<std::size_t>(values.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::nth_element(order.begin(), order.begin() + (most - 1), order.end(),
                     [&](Index a, Index b) { return std::pair(values[a], a) < std::pair(values[b], b); });
    order.resize(static_cast<std::size_t>(most));
    std::sort(order.begin(), order.end());
    return order;
}

/// The rows of a data set whose first extent counts what `chosen` chooses from.
io::Dataset chosen_rows(const io::Dataset& dataset, const std::vector<Index>& chosen) {
    io::Dataset part = dataset;
    part.shape.front() = chosen.size();
    const auto take = [&](const auto& values) {
        auto taken = values;
        taken.clear();
        const std::size_t width = values.size() / dataset.shape.front();
        for (const Index row : chosen) {
            const auto begin = values.begin() + row * static_cast<std::ptrdiff_t>(width);
            taken.insert(taken.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
        }
        return taken;
    };
    std::visit([&](const auto& values) { part.values = take(values); }, dataset.values);
    return part;
}

bool has_rows(const io::Dataset& dataset, Index count) {
    return !dataset.shape.empty() && dataset.shape.front() == static_cast<std::size_t>(count) &&
           !std::holds_alternative<std::string>(dataset.values);
}

Packing part_of_packing(const Packing& packing, const std::vector<Index>& chosen, const Eigen::VectorXd& distance) {
    const double half = distance(chosen).maxCoeff();
    const Cell& cell = packing.cell;
    Packing part;
    part.cell = Cell::of_edges(cell.place(Eigen::Vector3d::Constant(0.5 - half)), 2 * half * cell.edges(), {false, false, false});
    part.positions = packing.positions(Eigen::all, chosen);
    part.radii = packing.radii(chosen);
    return part;
}

/// The bonds that stay, and which of the old ones they are.
std::pair<ContactNetwork, std::vector<Index>> part_of_bonds(const Packing& packing, const ContactNetwork& bonds,
                                                            const std::vector<Index>& chosen) {
    std::vector<Index> number(static_cast<std::size_t>(packing.size()), -1);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        number[static_cast<std::size_t>(chosen[k])] = static_cast<Index>(k);
    }
    std::vector<Index> kept;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const auto [first, second] = std::pair(bonds.ends(0, bond), bonds.ends(1, bond));
        const Eigen::Vector3d direct = packing.positions.col(second) - packing.positions.col(first);
        const bool through_boundary = packing.cell.in_edges(bonds.branch.col(bond) - direct).cwiseAbs().maxCoeff() > 0.5;
        if (number[static_cast<std::size_t>(first)] >= 0 && number[static_cast<std::size_t>(second)] >= 0 && !through_boundary) {
            kept.push_back(bond);
        }
    }
    ContactNetwork part;
    part.particles = static_cast<Index>(chosen.size());
    part.ends = bonds.ends(Eigen::all, kept);
    part.branch = bonds.branch(Eigen::all, kept);
    for (auto& end : part.ends.reshaped()) {
        end = static_cast<std::remove_reference_t<decltype(end)>>(number[static_cast<std::size_t>(end)]);
    }
    return {std::move(part), std::move(kept)};
}

characterize::LargestPores part_of_pores(const characterize::LargestPores& pores, const Cell& cell, double half) {
    if (pores.size() == 0) {
        return pores;
    }
    const Eigen::VectorXd distance = distance_from_middle(cell, pores.centres);
    std::vector<Index> inside;
    for (Index k = 0; k < pores.size(); ++k) {
        if (distance[k] <= half) {
            inside.push_back(k);
        }
    }
    return {pores.centres(Eigen::all, inside), pores.radii(inside)};
}

}  // namespace

PageStructure thinned(const PageStructure& page, Index most) {
    require(most > 0, "a page shows at least one particle of a structure");
    const Packing& whole = page.structure.packing;
    if (whole.size() <= most) {
        return page;
    }
    const Eigen::VectorXd distance = distance_from_middle(whole.cell, whole.positions);
    const std::vector<Index> chosen = numbers_of_smallest(distance, most);
    PageStructure part = page;
    part.structure.packing = part_of_packing(whole, chosen, distance);
    part.structure.earlier.clear();
    part.pores = part_of_pores(page.pores, whole.cell, distance(chosen).maxCoeff());
    for (io::Dataset& field : part.fields) {
        field = has_rows(field, whole.size()) ? chosen_rows(field, chosen) : field;
    }
    if (page.structure.bonds) {
        auto [bonds, kept] = part_of_bonds(whole, *page.structure.bonds, chosen);
        for (io::Dataset& result : part.results) {
            const bool of_bonds =
                result.path.find("/bonds/") != std::string::npos && has_rows(result, page.structure.bonds->size());
            result = of_bonds ? chosen_rows(result, kept) : result;
        }
        part.structure.bonds = std::move(bonds);
    }
    return part;
}

}  // namespace coagula::report
