// SPDX-License-Identifier: GPL-3.0-or-later
#include "read_structure.hpp"

#include <coagula/io/trajectory_file.hpp>

#include <cmath>

#include "child_process.hpp"
#include "h5md_elements.hpp"
#include "layout.hpp"
#include "packed.hpp"
#include "results.hpp"

namespace coagula::io {

namespace {

using h5md::Element;
using h5md::find_element;
using h5md::number_of_particles;
using h5md::read_lengths;
using h5md::require_shape;
using hdf5::File;
using hdf5::Shape;

Cell read_cell(const File& file, const std::string& box) {
    if (!file.is_group(box)) {
        file.fail(box, "is missing");
    }
    const std::array<bool, 3> periodic = h5md::read_periodicity(file, box);
    const Eigen::Matrix3d edges = h5md::read_edges(file, box + "/edges").back();
    const std::string origin = box + "/origin";
    const auto lower = file.has(origin) ? read_lengths(file, origin, {3}) : std::vector<double>(3, 0.0);
    const bool is_periodic = periodic[0] && periodic[1] && periodic[2];
    const Eigen::Vector3d corner = is_periodic ? Eigen::Vector3d::Zero() : Eigen::Vector3d(Eigen::Vector3d::Map(lower.data()));
    return Cell::of_edges(corner, edges, periodic);
}

/// The data set of the radii, by the name of coagula or by that of other programs.
std::string radius_object(const File& file, const std::string& group) {
    for (const char* name : {"/radius", "/radii"}) {
        if (file.has(group + name)) {
            return group + name;
        }
    }
    file.fail(group + "/radius",
              "is missing: without radii this is not a packing of spheres; coagula import takes them from --radius");
}

Packing read_packing(const File& file, const std::string& group) {
    const std::string position = group + "/position";
    const std::size_t particles = number_of_particles(file, position);
    const auto coordinates = read_lengths(file, position, {particles, 3});
    const auto radii = read_lengths(file, radius_object(file, group), {particles});
    if (const std::string id = group + "/id"; file.is_dataset(id)) {
        require_shape(file, id, {particles});
    }
    const auto number = static_cast<Index>(particles);
    return {read_cell(file, group + "/box"), Eigen::Matrix3Xd::Map(coordinates.data(), 3, number),
            Eigen::VectorXd::Map(radii.data(), number)};
}

Eigen::Matrix3Xd read_branches(const File& file, const Packing& packing, const ContactNetwork& bonds) {
    const auto number = static_cast<std::size_t>(bonds.size());
    Eigen::Matrix3Xd branches(3, bonds.size());
    if (file.has(layout::branch_vectors)) {
        const auto values = read_lengths(file, layout::branch_vectors, {number, 3});
        branches = Eigen::Matrix3Xd::Map(values.data(), 3, bonds.size());
    } else {
        for (Index bond = 0; bond < bonds.size(); ++bond) {
            branches.col(bond) =
                packing.cell.minimum_image(packing.positions.col(bonds.ends(1, bond)) - packing.positions.col(bonds.ends(0, bond)));
        }
    }
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const double length = branches.col(bond).norm();
        if (!(std::isfinite(length) && length > 0)) {
            file.fail(layout::branch_vectors, "has bond " + std::to_string(bond) + " of length " + to_text(length) + " m");
        }
    }
    return branches;
}

std::optional<ContactNetwork> read_bonds(const File& file, const Packing& packing) {
    if (!file.has(layout::bonds)) {
        return std::nullopt;
    }
    const Shape shape = file.shape(layout::bonds);
    if (shape.size() != 2 || shape[1] != 2) {
        file.fail(layout::bonds, "has the shape " + h5md::shape_text(shape) + ", but [bonds][2] is expected");
    }
    const auto ends = file.read<std::int64_t>(layout::bonds);
    ContactNetwork bonds;
    bonds.particles = packing.size();
    bonds.ends.resize(2, static_cast<Index>(shape[0]));
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (ends[i] < 0 || ends[i] >= packing.size()) {
            file.fail(layout::bonds, "has bond " + std::to_string(i / 2) + " to particle " + std::to_string(ends[i]) +
                                         ", but particles are numbered from 0 to " + std::to_string(packing.size() - 1));
        }
        bonds.ends.data()[i] = static_cast<std::int32_t>(ends[i]);
    }
    bonds.branch = read_branches(file, packing, bonds);
    return bonds;
}

void require_same_boxes(const File& file, const std::string& edges, std::size_t frames) {
    const Element element = find_element(file, edges);
    if (!element.has_frames) {
        return;
    }
    Shape slice = file.shape(element.data);
    slice.erase(slice.begin());
    const std::vector<double> values = read_lengths(file, edges, slice, true);
    const std::size_t size = values.size() / frames;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] != values[values.size() - size + i % size]) {
            file.fail(element.data, "changes from frame to frame; coagula follows trajectories in a box that stays the same");
        }
    }
}

void read_earlier(const File& file, const std::string& group, Structure& structure) {
    const std::string position = group + "/position";
    if (!find_element(file, position).has_frames) {
        return;
    }
    const Index particles = structure.packing.size();
    const std::vector<double> values = read_lengths(file, position, {static_cast<std::size_t>(particles), 3}, true);
    const std::size_t frames = values.size() / static_cast<std::size_t>(3 * particles);
    require_same_boxes(file, group + "/box/edges", frames);
    const std::vector<double> times = h5md::read_times(file, position, frames);
    for (std::size_t frame = 0; frame + 1 < frames; ++frame) {
        const double* first = values.data() + frame * static_cast<std::size_t>(3 * particles);
        structure.earlier.push_back({times[frame], Eigen::Matrix3Xd::Map(first, 3, particles)});
        if (!structure.earlier.back().positions.allFinite()) {
            file.fail(position, "has a coordinate in frame " + std::to_string(frame) + " that is not a finite number");
        }
    }
    structure.time = times.back();
}

/// Group and structure as a child process has read them. The checks run in the calling process: they use threads, and their
/// sentences come from values alone.
Structure take_structure(Unpacker& found, const std::string& path) {
    const auto group = found.take<std::string>();
    auto structure = found.take<Structure>();
    try {
        check(structure.packing, path + ": " + group);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what());
    }
    if (const double fraction = volume_fraction(structure.packing); fraction > 1) {
        throw InputError(path + ": " + group + " is overfull: its spheres take " + to_text(fraction) +
                         " times the volume of the box");
    }
    return structure;
}

}  // namespace

std::string particles_group(const File& file) {
    if (file.attribute("/", "format") == layout::format_of_sets) {
        throw InputError(
            file.path() +
            " is a data set of many structures: coagula dataset table lists them, coagula report --structure ID shows one");
    }
    if (!file.is_group(layout::metadata) || !file.is_group(layout::particles)) {
        file.fail(file.is_group(layout::metadata) ? layout::particles : layout::metadata, "is missing: this is not an H5MD file");
    }
    const auto groups = file.children(layout::particles);
    if (file.is_group(layout::trajectory)) {
        return layout::trajectory;
    }
    if (groups.size() != 1) {
        file.fail(layout::trajectory, "is missing");
    }
    return std::string(layout::particles) + "/" + groups[0];
}

Structure read_structure(const File& file) {
    const Packing packing = read_packing(file, particles_group(file));
    return {packing, read_bonds(file, packing)};
}

Structure read_structure(const std::string& path) {
    Unpacker found(run_in_child(path, [&](ReadingLimits& /*limits*/) {
        const File file = File::open(path);
        Packer packer;
        packer(particles_group(file), read_structure(file));
        return packer.take();
    }));
    return take_structure(found, path);
}

Structure read_trajectory(const std::string& path) {
    Unpacker found(run_in_child(path, [&](ReadingLimits& /*limits*/) {
        const File file = File::open(path);
        Structure structure = read_structure(file);
        read_earlier(file, particles_group(file), structure);
        Packer packer;
        packer(particles_group(file), structure);
        return packer.take();
    }));
    return take_structure(found, path);
}

Contents read_contents(const std::string& path) {
    Unpacker found(run_in_child(path, [&](ReadingLimits& /*limits*/) {
        const File file = File::open(path);
        Packer packer;
        packer(particles_group(file), read_structure(file), results_in(file, "/characterization"), results_in(file, "/mechanics"),
               results_in(file, layout::provenance));
        return packer.take();
    }));
    Contents contents{take_structure(found, path), found.take<std::vector<Dataset>>(), {}};
    for (Dataset& dataset : found.take<std::vector<Dataset>>()) {
        contents.results.push_back(std::move(dataset));
    }
    contents.history = history_of(found.take<std::vector<Dataset>>());
    return contents;
}

}  // namespace coagula::io
