// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/vtk_file.hpp>

#include "vtk_view.hpp"

namespace coagula::io {

namespace {

/// An array of VTK's XML with one line per entry.
class DataArray {
public:
    DataArray(const std::string& type, const std::string& name, int components)
        : text_("        <DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                std::to_string(components) + "\" format=\"ascii\">\n") {}
    void line(const std::string& numbers) { text_ += numbers + '\n'; }
    std::string text() const { return text_ + "        </DataArray>\n"; }

private:
    std::string text_;
};

/// Vertices or lines: the points of each, and where it ends in their list.
std::string cells_text(const std::string& kind, const std::vector<std::vector<Index>>& cells) {
    DataArray points("Int64", "connectivity", 1);
    DataArray ends("Int64", "offsets", 1);
    std::size_t end = 0;
    for (const std::vector<Index>& cell : cells) {
        std::string line;
        for (const Index point : cell) {
            line += (line.empty() ? "" : " ") + std::to_string(point);
        }
        points.line(line);
        ends.line(std::to_string(end += cell.size()));
    }
    return "      <" + kind + ">\n" + points.text() + ends.text() + "      </" + kind + ">\n";
}

std::string point_data(const Packing& packing) {
    DataArray radius("Float64", "radius", 1);
    DataArray id("Int64", "id", 1);
    for (Index particle = 0; particle < packing.size(); ++particle) {
        radius.line(to_text(packing.radii[particle]));
        id.line(std::to_string(particle));
    }
    return "      <PointData Scalars=\"radius\">\n" + radius.text() + id.text() + "      </PointData>\n";
}

}  // namespace

void write_vtk(const std::string& path, const Structure& structure, bool overwrite) {
    check_output(path, overwrite);
    const Packing& packing = structure.packing;
    check(packing);
    DataArray points("Float64", "Points", 3);
    std::vector<std::vector<Index>> vertices;
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d centre = packing.positions.col(particle);
        points.line(to_text(centre[0]) + ' ' + to_text(centre[1]) + ' ' + to_text(centre[2]));
        vertices.push_back({particle});
    }
    std::vector<std::vector<Index>> lines;
    for (Index bond = 0; structure.bonds && bond < structure.bonds->size(); ++bond) {
        if (lies_inside(packing, *structure.bonds, bond)) {
            lines.push_back({structure.bonds->ends(0, bond), structure.bonds->ends(1, bond)});
        }
    }
    const std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n  <PolyData>\n    <Piece NumberOfPoints=\"" +
        std::to_string(packing.size()) + "\" NumberOfVerts=\"" + std::to_string(vertices.size()) + "\" NumberOfLines=\"" +
        std::to_string(lines.size()) + "\">\n" + point_data(packing) + "      <Points>\n" + points.text() + "      </Points>\n" +
        cells_text("Verts", vertices) + cells_text("Lines", lines) + "    </Piece>\n  </PolyData>\n</VTKFile>\n";
    write_file(path, text, overwrite);
}

}  // namespace coagula::io
