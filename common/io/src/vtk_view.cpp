// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_view.hpp"

#include "layout.hpp"

namespace coagula::io {

namespace {

using hdf5::File;

constexpr std::uint8_t vtk_vertex = 1;
constexpr std::uint8_t vtk_line = 3;

std::string in_view(const std::string& name) {
    return std::string(layout::view) + "/" + name;
}

/// Unstructured grid cells in VTK's order: the corners of all cells in a row, where each begins, and its type.
struct GridCells {
    std::vector<std::int64_t> connectivity;
    std::vector<std::int64_t> offsets{0};
    std::vector<std::uint8_t> types;

    void close(std::uint8_t type) {
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        types.push_back(type);
    }
};

GridCells grid_cells(const Packing& packing, const std::optional<ContactNetwork>& bonds) {
    GridCells cells;
    for (Index particle = 0; particle < packing.size(); ++particle) {
        cells.connectivity.push_back(particle);
        cells.close(vtk_vertex);
    }
    for (Index bond = 0; bonds && bond < bonds->size(); ++bond) {
        if (lies_inside(packing, *bonds, bond)) {
            cells.connectivity.insert(cells.connectivity.end(), {bonds->ends(0, bond), bonds->ends(1, bond)});
            cells.close(vtk_line);
        }
    }
    return cells;
}

void write_size(File& file, const std::string& name, std::size_t size) {
    const auto value = static_cast<std::int64_t>(size);
    file.write(in_view(name), {1}, &value);
}

}  // namespace

bool lies_inside(const Packing& packing, const ContactNetwork& bonds, Index bond) {
    const Eigen::Vector3d separation = packing.positions.col(bonds.ends(1, bond)) - packing.positions.col(bonds.ends(0, bond));
    return (packing.cell.in_edges(separation - bonds.branch.col(bond)).array().abs() < 0.5).all();
}

void write_view_bonds(File& file, const Packing& packing, const std::optional<ContactNetwork>& bonds) {
    file.remove(in_view("CellData"));
    file.create_group(in_view("CellData"));
    const GridCells cells = grid_cells(packing, bonds);
    write_size(file, "NumberOfCells", cells.types.size());
    write_size(file, "NumberOfConnectivityIds", cells.connectivity.size());
    file.write(in_view("Connectivity"), {cells.connectivity.size()}, cells.connectivity.data());
    file.write(in_view("Offsets"), {cells.offsets.size()}, cells.offsets.data());
    file.write(in_view("Types"), {cells.types.size()}, cells.types.data());
    if (bonds) {
        const Eigen::VectorXi counts = contact_counts(*bonds);
        const std::string coordination = in_view("PointData/coordination");
        file.write(coordination, {static_cast<std::size_t>(counts.size())}, counts.data());
        file.describe(coordination, "1", "number of bonds of the particle");
    }
}

void write_view(File& file, const Packing& packing, const std::optional<ContactNetwork>& bonds) {
    file.remove(layout::view);
    file.create_group(in_view("PointData"));
    file.set_attribute(layout::view, "Version", std::vector<std::int64_t>{1, 0});
    file.set_attribute(layout::view, "Type", "UnstructuredGrid");
    const auto particles = static_cast<std::size_t>(packing.size());
    write_size(file, "NumberOfPoints", particles);
    const Eigen::Matrix3Xf points = packing.positions.cast<float>();
    file.write(in_view("Points"), {particles, 3}, points.data());
    file.describe(in_view("Points"), "m", "centres of the particles in single precision, to be looked at");
    write_view_field(file, packing.size(), {"radius", packing.radii.transpose(), "m", "radius of the particle"});
    write_view_bonds(file, packing, bonds);
}

void write_view_field(File& file, Index particles, const ParticleField& field) {
    require(field.values.cols() == particles && field.values.rows() > 0, "the field '" + field.name + "' has " +
                                                                             std::to_string(field.values.cols()) + " columns for " +
                                                                             std::to_string(particles) + " particles");
    require(!field.name.empty() && field.name.find('/') == std::string::npos, "'" + field.name + "' cannot be the name of a field");
    hdf5::Shape shape{static_cast<std::size_t>(particles)};
    if (field.values.rows() > 1) {
        shape.push_back(static_cast<std::size_t>(field.values.rows()));
    }
    const std::string path = in_view("PointData/" + field.name);
    file.write(path, shape, field.values.data());
    file.describe(path, field.unit, field.description);
}

void write_view_bond_field(File& file, const Packing& packing, const ContactNetwork& bonds, const BondField& field) {
    require(field.values.size() == bonds.size(), "the field '" + field.name + "' has " + std::to_string(field.values.size()) +
                                                     " values for " + std::to_string(bonds.size()) + " bonds");
    std::vector<float> values(static_cast<std::size_t>(packing.size()), 0.0F);
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        if (lies_inside(packing, bonds, bond)) {
            values.push_back(static_cast<float>(field.values[bond]));
        }
    }
    const std::string path = in_view("CellData/" + field.name);
    file.write(path, {values.size()}, values.data());
    file.describe(path, field.unit, field.description);
}

}  // namespace coagula::io
