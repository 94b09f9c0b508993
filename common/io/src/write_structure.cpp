// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/conditions.hpp>
#include <coagula/io/structure_file.hpp>

#include <filesystem>

#include "child_process.hpp"
#include "hdf5_file.hpp"
#include "layout.hpp"
#include "read_structure.hpp"
#include "results.hpp"
#include "vtk_view.hpp"
#include "write_structure.hpp"

namespace coagula::io {

namespace {

using hdf5::File;

std::string in_trajectory(const std::string& name) {
    return std::string(layout::trajectory) + "/" + name;
}

/// H5MD 1.1, section "H5MD root level", with its units module.
void write_metadata(File& file) {
    const std::string metadata = layout::metadata;
    for (const char* group : {"/author", "/creator", "/modules/units"}) {
        file.create_group(metadata + group);
    }
    file.set_attribute(metadata, "version", std::vector<std::int64_t>{1, 1});
    file.set_attribute(metadata + "/author", "name", "not stated");
    file.set_attribute(metadata + "/creator", "name", "coagula");
    file.set_attribute(metadata + "/creator", "version", COAGULA_VERSION);
    file.set_attribute(metadata + "/modules/units", "version", std::vector<std::int64_t>{1, 0});
    file.set_attribute(metadata + "/modules/units", "system", "SI");
}

/// The frames before the packing itself, which is the last.
void write_positions(File& file, const Structure& structure) {
    const Packing& packing = structure.packing;
    const std::size_t frames = structure.earlier.size() + 1;
    const Index particles = packing.size();
    Eigen::Matrix3Xd positions(3, static_cast<Index>(frames) * particles);
    std::vector<double> times;
    std::vector<std::int64_t> steps;
    for (const Frame& frame : structure.earlier) {
        const auto number = static_cast<Index>(times.size());
        positions.middleCols(number * particles, particles) =
            layout::stored_positions({packing.cell, frame.positions, packing.radii});
        steps.push_back(number);
        times.push_back(frame.time);
    }
    positions.rightCols(particles) = layout::stored_positions(packing);
    steps.push_back(static_cast<std::int64_t>(times.size()));
    times.push_back(structure.time);
    const std::string position = in_trajectory("position");
    file.write(position + "/value", {frames, static_cast<std::size_t>(particles), 3}, positions.data());
    file.describe(position + "/value", "nm", "centres of the particles");
    file.write(position + "/step", {frames}, steps.data());
    file.describe(position + "/step", "1", "number of the frame");
    file.write(position + "/time", {frames}, times.data());
    file.describe(position + "/time", "s", "time of the frame");
}

void write_box(File& file, const Cell& cell, std::size_t frames) {
    const std::string box = in_trajectory("box");
    const Eigen::Matrix3Xd edges = (cell.edges() * layout::nanometres).replicate(1, static_cast<Index>(frames));
    file.write(box + "/edges/value", {frames, 3, 3}, edges.data());
    file.describe(box + "/edges/value", "nm", "edge vectors of the box, one per row");
    file.link(in_trajectory("position/step"), box + "/edges/step");
    file.link(in_trajectory("position/time"), box + "/edges/time");
    const Eigen::Vector3d origin = cell.origin() * layout::nanometres;
    file.write(box + "/origin", {3}, origin.data());
    file.describe(box + "/origin", "nm", "corner of the box from which its edges go");
    file.set_attribute(box, "dimension", std::int64_t{3});
    std::vector<std::string> boundary;
    for (int axis = 0; axis < 3; ++axis) {
        boundary.emplace_back(cell.is_periodic(axis) ? "periodic" : "none");
    }
    file.set_attribute(box, "boundary", boundary);
}

void write_particles(File& file, const Structure& structure) {
    const Packing& packing = structure.packing;
    write_positions(file, structure);
    write_box(file, packing.cell, structure.earlier.size() + 1);
    const auto particles = static_cast<std::size_t>(packing.size());
    const Eigen::VectorXd radii = packing.radii * layout::nanometres;
    file.write(in_trajectory("radius"), {particles}, radii.data());
    file.describe(in_trajectory("radius"), "nm", "radii of the particles");
    std::vector<std::int64_t> ids(particles);
    for (std::size_t particle = 0; particle < particles; ++particle) {
        ids[particle] = static_cast<std::int64_t>(particle);
    }
    file.write(in_trajectory("id"), {particles}, ids.data());
    file.describe(in_trajectory("id"), "1", "numbers by which the particles are named");
}

void write_bonds(File& file, const std::string& particles_group, const ContactNetwork& bonds) {
    const auto number = static_cast<std::size_t>(bonds.size());
    file.write(layout::bonds, {number, 2}, bonds.ends.data());
    file.describe(layout::bonds, "1", "ids of the two particles that each bond joins");
    file.set_reference(layout::bonds, "particles_group", particles_group);
    file.write(layout::branch_vectors, {number, 3}, bonds.branch.data());
    file.describe(layout::branch_vectors, "m",
                  "vector from the first to the second centre of each bond, through the periodic boundary");
}

/// The file may have been replaced since its packing was read.
void check_same_packing(const std::string& source, const Packing& packing, const Addition& added) {
    const std::string& expected = added.provenance.positions_sha256;
    if (!expected.empty() && expected != positions_sha256(packing)) {
        throw std::runtime_error(source + " holds another packing than when this run began; its results are not written");
    }
    require(!added.bonds || added.bonds->particles == packing.size(), "the bonds are those of another packing");
    require(added.bonds || added.bond_fields.empty(), "fields of bonds need bonds");
}

bool are_equal(const ContactNetwork& one, const ContactNetwork& other) {
    return one.size() == other.size() && one.ends == other.ends && one.branch == other.branch;
}

/// Results of the old list of bonds keep it: a second name of the same data.
void keep_bonds_of_results(File& file) {
    for (const std::string& method : file.children(layout::mechanics)) {
        const std::string group = std::string(layout::mechanics) + "/" + method;
        const std::string own = group + layout::connectivity;
        if (!file.is_group(group) || file.has(own)) {
            continue;
        }
        for (const std::string& name : file.children(layout::connectivity)) {
            const std::string place = "/" + name;
            file.link(layout::connectivity + place, own + place);
        }
    }
}

/// @param present the bonds in the file.
void add_to(File& file, const Packing& packing, const std::optional<ContactNetwork>& present, const std::string& particles_group,
            const Addition& added) {
    for (const std::string& group : added.replaced) {
        file.remove(group);
    }
    if (added.bonds && present && !are_equal(*added.bonds, *present)) {
        keep_bonds_of_results(file);
    }
    if (added.bonds) {
        write_bonds(file, particles_group, *added.bonds);
    }
    if (!file.has(layout::view)) {
        write_view(file, packing, added.bonds ? added.bonds : present);
    } else if (added.bonds) {
        write_view_bonds(file, packing, added.bonds);
    }
    for (const ParticleField& field : added.fields) {
        write_view_field(file, packing.size(), field);
    }
    for (const BondField& field : added.bond_fields) {
        write_view_bond_field(file, packing, *added.bonds, field);
    }
    for (const Dataset& dataset : added.results) {
        write_dataset(file, dataset);
    }
    write_provenance(file, added.provenance);
}

}  // namespace

File built_structure(const std::string& path, const Structure& structure, const std::vector<ParticleField>& fields,
                     const std::vector<Dataset>& results, const Provenance& provenance, const std::vector<Addition>& later) {
    check(structure.packing);
    require(!structure.bonds || structure.bonds->particles == structure.packing.size(), "the bonds are those of another packing");
    for (const Frame& frame : structure.earlier) {
        require(frame.positions.cols() == structure.packing.size(), "a frame of the trajectory has another number of particles");
    }
    File file = File::create(path);
    write_metadata(file);
    write_particles(file, structure);
    if (structure.bonds) {
        write_bonds(file, layout::trajectory, *structure.bonds);
    }
    write_view(file, structure.packing, structure.bonds);
    for (const ParticleField& field : fields) {
        write_view_field(file, structure.packing.size(), field);
    }
    for (const Dataset& dataset : results) {
        write_dataset(file, dataset);
    }
    write_provenance(file, provenance);
    std::optional<ContactNetwork> bonds = structure.bonds;
    for (const Addition& added : later) {
        check_same_packing(path, structure.packing, added);
        add_to(file, structure.packing, bonds, layout::trajectory, added);
        bonds = added.bonds ? added.bonds : bonds;
    }
    return file;
}

void write_structure(const std::string& path, const Structure& structure, const std::vector<ParticleField>& fields,
                     const std::vector<Dataset>& results, const Provenance& provenance, bool overwrite,
                     const std::vector<Addition>& later) {
    check_output(path, overwrite);
    File file = built_structure(path, structure, fields, results, provenance, later);
    write_file(path, file.close(), overwrite);
}

void add_results(const std::string& source, const std::string& target, const Addition& added, bool overwrite) {
    std::error_code missing;
    const bool in_place = std::filesystem::equivalent(source, target, missing);
    OutputFile output(target, overwrite || in_place);  // from here on nobody else adds to the file
    for (const std::string& group : in_place && !overwrite ? added.replaced : std::vector<std::string>()) {
        check_conditions(source, group, added.results);
    }
    const std::string bytes = run_in_child(source, [&](ReadingLimits& limits) {
        const File old = File::open(source);
        const Structure structure = read_structure(old);
        check_same_packing(source, structure.packing, added);
        File file = File::create(target);
        file.copy_all_from(old);
        limits.lift();
        add_to(file, structure.packing, structure.bonds, particles_group(old), added);
        const std::span<const char> made = file.close();
        return std::string(made.begin(), made.end());
    });
    output.publish(bytes);
}

void check_source(const std::string& source) {
    run_in_child(source, [&](ReadingLimits& /*limits*/) {
        File::create(source).copy_all_from(File::open(source));  // in memory only
        return std::string();
    });
}

}  // namespace coagula::io
