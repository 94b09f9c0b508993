// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/gsd_file.hpp>

#include <algorithm>
#include <cmath>

#include "gsd_container.hpp"
#include "gsd_diameters.hpp"
#include "triclinic.hpp"

namespace coagula::io {

namespace {

/// A single number of the first frame; `otherwise` where the frame does not have it.
double number_of_file(const GsdFile& file, const std::string& name, double otherwise) {
    const std::vector<double> found = file.numbers(0, name);
    return found.size() == 1 ? found[0] : otherwise;
}

/// A file that does not name its dimensions has two when its box is flat (schema hoomd).
void require_three_dimensions(const GsdFile& file, std::uint64_t frame, bool flat) {
    const std::vector<double> found = file.numbers_or_first(frame, "configuration/dimensions");
    const double dimensions = found.size() == 1 ? found[0] : flat ? 2 : 3;
    if (dimensions != 3) {
        file.fail("frame " + std::to_string(frame) + " has " + to_text(dimensions) +
                  " dimensions (configuration/dimensions), but coagula reads three-dimensional packings only");
    }
}

/// HOOMD stores the body of a rigid body as a particle of its own, which is no sphere of the packing.
void refuse_rigid_bodies(const GsdFile& file, std::uint64_t frame, std::size_t count) {
    const std::vector<double> bodies = file.values(frame, "particles/body", count, 1);
    const auto found = std::find_if(bodies.begin(), bodies.end(), [](double body) { return body >= 0; });
    if (found != bodies.end()) {
        file.fail("particle " + std::to_string(found - bodies.begin()) + " of frame " + std::to_string(frame) +
                  " belongs to a rigid body (particles/body); write a file of the spheres alone, without bodies and their centres");
    }
}

Cell cell_of(const GsdFile& file, std::uint64_t frame, double metres, const std::array<bool, 3>& periodic) {
    const std::vector<double> box = file.values(frame, "configuration/box", 1, 6);
    if (box.empty()) {
        file.fail("frame " + std::to_string(frame) + " has no box of six numbers");
    }
    require_three_dimensions(file, frame, box[2] == 0);
    const Eigen::Vector3d lengths = Eigen::Vector3d(box[0], box[1], box[2]) * metres;
    for (const double length : lengths) {
        if (!(std::isfinite(length) && length > 0)) {
            file.fail("the box of frame " + std::to_string(frame) + " has an edge that is not positive");
        }
    }
    // HOOMD's tilt factors are over the length of the edge that is tilted less, and positions count from the middle.
    const Eigen::Matrix3d edges =
        triclinic_edges(lengths, Eigen::Vector3d(box[3] * lengths[1], box[4] * lengths[2], box[5] * lengths[2]));
    return Cell::of_edges(-0.5 * edges.rowwise().sum(), edges, periodic);
}

/// GSD names none: its boxes are periodic, unless coagula wrote a flag for all axes or for each.
std::array<bool, 3> periodicity_of(const GsdFile& file, bool open) {
    std::vector<double> flags = file.numbers(0, "log/coagula/periodic");
    flags.resize(3, flags.empty() ? 1.0 : flags[0]);
    return {flags[0] != 0 && !open, flags[1] != 0 && !open, flags[2] != 0 && !open};
}

std::size_t number_of_particles(const GsdFile& file, std::uint64_t frame) {
    const std::vector<double> number = file.numbers_or_first(frame, "particles/N");
    if (number.size() != 1 || !(number[0] > 0)) {
        file.fail("frame " + std::to_string(frame) + " has no particles");
    }
    if (number[0] > static_cast<double>(file.size())) {
        file.fail("frame " + std::to_string(frame) + " has more particles than the file has bytes");
    }
    return static_cast<std::size_t>(number[0]);
}

RawPacking read_frame(const GsdFile& file, std::uint64_t frame, double metres, const std::array<bool, 3>& periodic,
                      bool with_radii) {
    const std::size_t count = number_of_particles(file, frame);
    refuse_rigid_bodies(file, frame, count);
    RawPacking raw;
    raw.slack = 1e-6;  // single precision
    raw.cell = cell_of(file, frame, metres, periodic);
    raw.coordinates = file.values(frame, "particles/position", count, 3);
    if (raw.coordinates.empty()) {
        file.fail("frame " + std::to_string(frame) + " has no 'particles/position'");
    }
    for (double& coordinate : raw.coordinates) {
        coordinate *= metres;
    }
    if (with_radii) {
        raw.radii = gsd_diameters(file, frame, count);
        std::transform(raw.radii.begin(), raw.radii.end(), raw.radii.begin(), [&](double value) { return 0.5 * value * metres; });
    }
    const std::vector<double> time = file.numbers(frame, "log/coagula/time");
    raw.time = time.size() == 1 && std::isfinite(time[0]) ? time[0] : unset;
    return raw;
}

}  // namespace

Structure read_gsd(const std::string& path, const ImportOptions& options) {
    refuse_options_of_other_formats(path, options, std::nullopt);
    const GsdFile file(path);
    const double named = number_of_file(file, "log/coagula/length_unit", unset);
    const double metres = options.length_unit.value_or(named);
    if (std::isnan(metres)) {
        file.fail("GSD names no unit of length: give --length-unit");
    }
    const std::array<bool, 3> periodic = periodicity_of(file, options.open);
    FrameCollector collector(options);
    try {
        require_positive(metres, "the length unit", "m");
        const auto frames = static_cast<std::int64_t>(file.frames());
        double numbers = 0;  // a frame without positions has those of the first one: a short file could name many
        for (std::int64_t frame = 0; frame < frames; ++frame) {
            if (!collector.wants(frame, frames)) {
                collector.pass_over(frame);
                continue;
            }
            RawPacking raw = read_frame(file, static_cast<std::uint64_t>(frame), metres, periodic, !options.radius);
            numbers += static_cast<double>(raw.size());
            if (numbers > static_cast<double>(file.size())) {
                file.fail("the file is too short for the positions of its " + std::to_string(frames) + " frames");
            }
            collector.add(std::move(raw), frame);
        }
        return finish(path, collector.take(path), options);
    } catch (const std::invalid_argument& error) {
        const std::string sentence = error.what();
        throw InputError(sentence.starts_with(path) ? sentence : path + ": " + sentence);
    }
}

}  // namespace coagula::io
