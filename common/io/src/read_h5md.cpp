// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/h5md_file.hpp>

#include <algorithm>
#include <cstdint>

#include "child_process.hpp"
#include "h5md_elements.hpp"
#include "packed.hpp"
#include "read_structure.hpp"
#include "text_reader.hpp"

namespace coagula::io {

namespace {

using hdf5::File;
using hdf5::Shape;

/// What the file holds of each frame. Values that do not depend on time stand there once.
struct Elements {
    std::size_t particles = 0;
    std::vector<double> coordinates;  ///< [m]
    std::vector<double> radii;        ///< [m]; empty when the file names none
    std::vector<double> edges;        ///< [m]; empty when the file names no box, or another one is given
    std::array<bool, 3> periodic = {true, true, true};
    std::vector<double> corner;         ///< of the box [m]
    std::vector<std::int64_t> numbers;  ///< of the particles; empty when the file names none
    std::vector<double> times;

    std::size_t frames() const { return coordinates.size() / (3 * particles); }
};

/// One frame of values that depend on time or do not.
template <class T>
std::vector<T> slice_of(const std::vector<T>& values, std::size_t size, std::size_t frame) {
    const std::size_t begin = values.size() > size ? frame * size : 0;
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    return values.empty() ? std::vector<T>{} : std::vector<T>(first, first + static_cast<std::ptrdiff_t>(size));
}

void read_radii(const File& file, const std::string& group, bool all, const ImportOptions& options, Elements& found) {
    for (const char* name : {"/radius", "/radii", "/diameter"}) {
        if (options.radius || !file.has(group + name)) {
            continue;
        }
        found.radii = h5md::read_lengths(file, group + name, {found.particles}, all, options.length_unit);
        const double scale = std::string(name) == "/diameter" ? 0.5 : 1.0;
        std::transform(found.radii.begin(), found.radii.end(), found.radii.begin(), [&](double value) { return scale * value; });
        return;
    }
}

/// The box of the file, unless another one is given or an open set has a periodic one.
void read_box(const File& file, const std::string& box, bool all, const ImportOptions& options, Elements& found) {
    if (options.box || !file.is_group(box)) {
        return;
    }
    const std::vector<std::string> boundary = file.texts_attribute(box, "boundary");
    if (options.open && std::count(boundary.begin(), boundary.end(), "none") != 3) {
        return;
    }
    found.periodic = h5md::read_periodicity(file, box);
    for (const Eigen::Matrix3d& edges : h5md::read_edges(file, box + "/edges", all, options.length_unit)) {
        found.edges.insert(found.edges.end(), edges.data(), edges.data() + edges.size());
    }
    for (const char* name : {"/origin", "/offset"}) {  // of coagula, and of H5MD 1.0
        if (found.corner.empty() && file.has(box + name)) {
            found.corner = h5md::read_lengths(file, box + name, {3}, all, options.length_unit);
        }
    }
}

/// The numbers of the particles, which some programs write in another order in each frame.
void read_numbers_of_particles(const File& file, const std::string& object, bool all, Elements& found) {
    if (!file.has(object)) {
        return;
    }
    const h5md::Element element = h5md::find_element(file, object);
    Shape expected = {found.particles};
    if (const Shape shape = file.shape(element.data); element.has_frames && !shape.empty()) {
        expected.insert(expected.begin(), shape[0]);
    }
    h5md::require_shape(file, element.data, expected);
    const bool last = element.has_frames && !all;
    found.numbers = last ? file.read_last<std::int64_t>(element.data) : file.read<std::int64_t>(element.data);
    if (std::any_of(found.numbers.begin(), found.numbers.end(), [](std::int64_t number) { return number < 0; })) {
        file.fail(element.data, "has a number below 0: coagula reads files in which each particle is there in all frames");
    }
}

void require_frames_of(const File& file, const std::string& object, std::size_t values, std::size_t size, std::size_t frames) {
    if (values != 0 && values != size && values != size * frames) {
        file.fail(object, "has another number of frames than the positions");
    }
}

Elements read_elements(const File& file, const ImportOptions& options) {
    const std::string group = particles_group(file);
    const std::string position = group + "/position";
    const bool all = options.frame && options.frame->kind != FrameChoice::Kind::last;
    Elements found;
    found.particles = h5md::number_of_particles(file, position);
    found.coordinates = h5md::read_lengths(file, position, {found.particles, 3}, all, options.length_unit);
    read_radii(file, group, all, options, found);
    read_box(file, group + "/box", all, options, found);
    read_numbers_of_particles(file, group + "/id", all, found);
    const std::size_t frames = found.frames();
    require_frames_of(file, group + "/radius", found.radii.size(), found.particles, frames);
    require_frames_of(file, group + "/box", found.edges.size(), 9, frames);
    require_frames_of(file, group + "/box", found.corner.size(), 3, frames);
    require_frames_of(file, group + "/id", found.numbers.size(), found.particles, frames);
    found.times = all ? h5md::read_times(file, position, frames) : std::vector<double>{};
    return found;
}

RawPacking frame_of(const std::string& path, const Elements& found, std::size_t frame) {
    RawPacking raw;
    raw.slack = 1e-6;  // many programs write single precision
    raw.coordinates = slice_of(found.coordinates, 3 * found.particles, frame);
    raw.radii = slice_of(found.radii, found.particles, frame);
    raw.time = found.times.empty() ? unset : found.times[frame];
    const std::vector<double> edges = slice_of(found.edges, 9, frame);
    std::vector<double> corner = slice_of(found.corner, 3, frame);
    corner.resize(3, 0.0);
    if (!edges.empty()) {
        raw.cell = Cell::of_edges(Eigen::Vector3d::Map(corner.data()), Eigen::Matrix3d::Map(edges.data()), found.periodic);
    }
    if (!found.numbers.empty()) {
        const std::vector<std::int64_t> numbers = slice_of(found.numbers, found.particles, frame);
        sort_by_number(path, {numbers.begin(), numbers.end()}, raw);
    }
    return raw;
}

Elements take_elements(const std::string& path, const ImportOptions& options) {
    Unpacker packed(run_in_child(path, [&](ReadingLimits& /*limits*/) {
        const File file = File::open(path);
        const Elements found = read_elements(file, options);
        Packer packer;
        packer(found.particles, found.coordinates, found.radii, found.edges, found.periodic, found.corner, found.numbers,
               found.times);
        return packer.take();
    }));
    Elements found;
    packed(found.particles, found.coordinates, found.radii, found.edges, found.periodic, found.corner, found.numbers, found.times);
    return found;
}

}  // namespace

Structure read_h5md(const std::string& path, const ImportOptions& options) {
    refuse_options_of_other_formats(path, options, std::nullopt);
    if (options.length_unit) {
        require_positive(*options.length_unit, "the length unit", "m");
    }
    const Elements found = take_elements(path, options);
    FrameCollector collector(options);
    try {
        for (std::size_t frame = 0; frame < found.frames(); ++frame) {
            collector.add(frame_of(path, found, frame), static_cast<std::int64_t>(frame));
        }
        return finish(path, collector.take(path), options);
    } catch (const std::invalid_argument& error) {
        const std::string sentence = error.what();
        throw InputError(sentence.starts_with(path) ? sentence : path + ": " + sentence);
    }
}

}  // namespace coagula::io
