#include "counted_diagram.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

void keep_counted_edges(PowerDiagram& diagram) {
    const auto counted = [&](int site) { return diagram.counted[static_cast<std::size_t>(site)] != 0; };
    std::erase_if(diagram.edges,
                  [&](const DiagramEdge& edge) { return std::none_of(edge.around.begin(), edge.around.end(), counted); });
}

}  // namespace

PowerDiagram counted_diagram(const Packing& packing) {
    if (packing.cell.is_periodic()) {
        return periodic_diagram(packing, packing.radii);
    }
    PowerDiagram diagram = open_diagram(packing, packing.radii, std::vector<char>(static_cast<std::size_t>(packing.size()), 1));
    diagram.counted = inner_sites(diagram);
    keep_counted_edges(diagram);
    require(!diagram.edges.empty(), "the packing is open and has " + std::to_string(packing.size()) +
                                        " particles, but none lies so far inside that its Voronoi cell is certain");
    return diagram;
}

PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth) {
    const Eigen::VectorXd radii = packing.radii.array() + growth;
    return packing.cell.is_periodic() ? periodic_diagram(packing, radii, original.margin)
                                      : open_diagram(packing, radii, original.counted);
}

}  // namespace coagula::characterize
