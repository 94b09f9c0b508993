// SPDX-License-Identifier: GPL-3.0-or-later
#include "reduced_diagram.hpp"

#include <coagula/characterize/applicable.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

/// The diagram of a packing with a free surface, in which the inner particles are counted.
PowerDiagram inner_diagram(const Packing& packing) {
    PowerDiagram diagram = power_diagram(packing, packing.radii);
    diagram.counted = inner_sites(packing, diagram);
    const auto counted = [&](int site) { return diagram.counted[static_cast<std::size_t>(site)] != 0; };
    std::erase_if(diagram.edges,
                  [&](const DiagramEdge& edge) { return std::none_of(edge.around.begin(), edge.around.end(), counted); });
    return diagram;
}

}  // namespace

Packing in_units_of(double unit, const Packing& packing) {
    const Cell cell = packing.cell.reduced();
    Packing scaled{Cell::of_edges(cell.origin() / unit, cell.edges() / unit, cell.periodicity()), packing.positions / unit,
                   packing.radii / unit};
    if (!cell.is_rectangular()) {  // the box may have another shape now
        for (auto position : scaled.positions.colwise()) {
            position = scaled.cell.wrap(position);
        }
    }
    return scaled;
}

Index ReducedDiagram::inner_count() const {
    return std::count(diagram.counted.begin(), diagram.counted.begin() + packing.size(), char{1});
}

ReducedDiagram reduced_diagram(const Packing& packing) {
    ReducedDiagram reduced;
    reduced.unit = mean_radius(packing);
    reduced.packing = in_units_of(reduced.unit, packing);
    reduced.diagram =
        packing.cell.is_periodic() ? power_diagram(reduced.packing, reduced.packing.radii) : inner_diagram(reduced.packing);
    return reduced;
}

PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth, double margin) {
    const Eigen::VectorXd radii = packing.radii.array() + growth;
    return power_diagram(packing, radii, original.counted, margin);
}

void require_inner(const ReducedDiagram& reduced) {
    const std::string sentence = "the packing has a free surface and " + std::to_string(reduced.packing.size()) + " particles";
    require(reduced.packing.size() < 4 || !reduced.diagram.hull.empty(), sentence + " in one plane: it fills no space");
    require_applicable(!reduced.diagram.edges.empty(),
                       sentence + ", but none lies so far inside that its Voronoi cell is certain: a larger sample is needed");
}

}  // namespace coagula::characterize
