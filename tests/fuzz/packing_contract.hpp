// SPDX-License-Identifier: GPL-3.0-or-later
// What the fuzz targets of all text formats with coordinates ask of a packing.
#pragma once

#include <coagula/io/text_formats.hpp>

#include "reader_contract.hpp"

#include <array>

namespace coagula::fuzz {

/// Without options, as an open set with radius and unit, in a given box, and as a trajectory.
inline std::array<io::ImportOptions, 5> import_options() {
    return {io::ImportOptions{}, io::ImportOptions{.radius = 0.25, .box = {}, .open = true, .length_unit = 1.0},
            io::ImportOptions{
                .radius = {}, .box = Eigen::Matrix3d(Eigen::Vector3d(10, 11, 12).asDiagonal()), .length_unit = 1e-6, .wrap = true},
            io::ImportOptions{.radius = 0.25,
                              .box = Eigen::Matrix3d(Eigen::Vector3d(10, 11, 12).asDiagonal()),
                              .length_unit = 1.0,
                              .frame = io::FrameChoice{io::FrameChoice::Kind::all}},
            io::ImportOptions{.radius = {}, .box = {}, .length_unit = 1.0, .atom_style = "hybrid sphere bond", .wrap = true}};
}

/// @param read gives the Structure of a file, or throws an InputError that names its path.
template <class Read>
void expect_sound_packing(const std::string& path, const Read& read) {
    expect_value_or_sentence(path, [&] {
        const io::Structure structure = read();
        const Packing& packing = structure.packing;
        check(packing);
        expect(std::isfinite(structure.time), "the time is not finite");
        for (const io::Frame& frame : structure.earlier) {
            expect(frame.positions.cols() == packing.size() && frame.positions.allFinite(), "a frame is another one");
            expect(std::isfinite(frame.time), "the time of a frame is not finite");
        }
        expect(packing.cell.lengths().allFinite() && packing.cell.origin().allFinite(), "the box is not finite");
        const double fraction = volume_fraction(packing);
        expect(fraction > 0 && fraction <= 1, "the volume fraction is " + to_text(fraction));
    });
}

/// @param read gives the Structure of a path and options.
template <class Read>
int read_packing_by(const std::uint8_t* data, std::size_t size, const Read& read) {
    const std::string path = input_file(data, size, "packing");
    for (const io::ImportOptions& options : import_options()) {
        expect_sound_packing(path, [&] { return read(path, options); });
    }
    return 0;
}

inline int read_packing(const std::uint8_t* data, std::size_t size, io::TextFormat format) {
    return read_packing_by(data, size, [format](const std::string& path, const io::ImportOptions& options) {
        return io::read_frames(path, format, options);
    });
}

}  // namespace coagula::fuzz
