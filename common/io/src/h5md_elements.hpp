// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of an H5MD file (https://nongnu.org/h5md, "H5MD elements"), as coagula's own files and those of other programs have
// them.
#pragma once

#include <coagula/common/cell.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hdf5_file.hpp"

namespace coagula::io::h5md {

using hdf5::File;
using hdf5::Shape;

/// An H5MD element: `object`/value with one slice per frame where it depends on time, otherwise `object` itself.
struct Element {
    std::string data;
    bool has_frames;
};
Element find_element(const File& file, const std::string& object);

/// A shape as text, such as "[3][5]".
std::string shape_text(const Shape& shape);
void require_shape(const File& file, const std::string& object, const Shape& expected);

/// The last frame of an element whose slice has the shape `slice`, or all of them one after the other, in metres.
/// @param length_unit metres per unit of an element that names none, or none that is a length.
std::vector<double> read_lengths(const File& file, const std::string& object, const Shape& slice, bool all_frames = false,
                                 const std::optional<double>& length_unit = {});

/// Number of particles, from the shape of the positions. Throws InputError for more than 2^31 - 1 and for none.
std::size_t number_of_particles(const File& file, const std::string& position);

/// Whether a box is periodic along each edge, by its attribute `boundary`.
std::array<bool, 3> read_periodicity(const File& file, const std::string& box);

/// The edges of the box as columns [m], from three lengths or from a matrix with an edge in each row. There is one matrix for the
/// last frame, or one for each frame. A box that does not depend on time has a single one.
std::vector<Eigen::Matrix3d> read_edges(const File& file, const std::string& edges, bool all_frames = false,
                                        const std::optional<double>& length_unit = {});

/// Times of the frames [s]; their numbers where the file has no times in seconds.
std::vector<double> read_times(const File& file, const std::string& position, std::size_t frames);

}  // namespace coagula::io::h5md
