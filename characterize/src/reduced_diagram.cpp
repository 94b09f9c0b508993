#include "reduced_diagram.hpp"

#include <coagula/characterize/measure.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

/// The diagram of an open packing in which the inner particles are counted.
PowerDiagram inner_diagram(const Packing& packing) {
    PowerDiagram diagram = open_diagram(packing, packing.radii, std::vector<char>(static_cast<std::size_t>(packing.size()), 1));
    diagram.counted = inner_sites(diagram);
    const auto counted = [&](int site) { return diagram.counted[static_cast<std::size_t>(site)] != 0; };
    std::erase_if(diagram.edges,
                  [&](const DiagramEdge& edge) { return std::none_of(edge.around.begin(), edge.around.end(), counted); });
    return diagram;
}

}  // namespace

Packing in_units_of(double unit, const Packing& packing) {
    const Eigen::Vector3d lengths = packing.cell.lengths() / unit;
    const Eigen::Vector3d origin = packing.cell.origin() / unit;
    const bool periodic = packing.cell.is_periodic();
    return {periodic ? Cell::periodic(lengths) : Cell::open(origin, lengths), packing.positions / unit, packing.radii / unit};
}

Index ReducedDiagram::inner_count() const {
    return std::count(diagram.counted.begin(), diagram.counted.begin() + packing.size(), char{1});
}

ReducedDiagram reduced_diagram(const Packing& packing) {
    ReducedDiagram reduced;
    reduced.unit = mean_radius(packing);
    reduced.packing = in_units_of(reduced.unit, packing);
    reduced.diagram =
        packing.cell.is_periodic() ? periodic_diagram(reduced.packing, reduced.packing.radii) : inner_diagram(reduced.packing);
    return reduced;
}

PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth, double margin) {
    const Eigen::VectorXd radii = packing.radii.array() + growth;
    return packing.cell.is_periodic() ? periodic_diagram(packing, radii, margin) : open_diagram(packing, radii, original.counted);
}

void require_inner(const ReducedDiagram& reduced) {
    const std::string sentence = "the packing is open and has " + std::to_string(reduced.packing.size()) + " particles";
    require(reduced.packing.size() < 4 || !reduced.diagram.hull.empty(), sentence + " in one plane: it fills no space");
    require_applicable(!reduced.diagram.edges.empty(),
                       sentence + ", but none lies so far inside that its Voronoi cell is certain: a larger sample is needed");
}

}  // namespace coagula::characterize
