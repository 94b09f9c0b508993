// SPDX-License-Identifier: GPL-3.0-or-later
#include "h5md_elements.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace coagula::io::h5md {

namespace {

/// How many of the unit of a dataset are in a metre.
double per_metre(const File& file, const std::string& object, const std::optional<double>& length_unit) {
    const std::string unit = file.attribute(object, "unit");
    if (unit.empty() && !length_unit) {
        file.fail(object, "carries no unit; coagula import takes it from --length-unit");
    }
    if (unit.empty()) {
        return 1 / *length_unit;
    }
    try {
        return unit_factor("m", unit == "A" ? "angstrom" : unit);  // H5MD files name the angstrom so; UDUNITS means the ampere
    } catch (const InputError&) {
        if (length_unit) {
            return 1 / *length_unit;  // a name such as "sigma", whose length the user gives
        }
        file.fail(object, "has the unit '" + unit + "', which is not a length");
    }
}

/// `step` and `time` hold one number per frame (or the increment).
void require_frames(const File& file, const std::string& object, std::size_t frames) {
    for (const char* name : {"/step", "/time"}) {
        if (file.has(object + name) && !file.shape(object + name).empty()) {
            require_shape(file, object + name, {frames});
        }
    }
}

}  // namespace

std::string shape_text(const Shape& shape) {
    std::string text;
    for (const std::size_t length : shape) {
        text.append("[").append(std::to_string(length)).append("]");
    }
    return shape.empty() ? "of a single number" : text;
}

void require_shape(const File& file, const std::string& object, const Shape& expected) {
    const Shape found = file.shape(object);
    if (found != expected) {
        file.fail(object, "has the shape " + shape_text(found) + ", but " + shape_text(expected) + " is expected");
    }
}

Element find_element(const File& file, const std::string& object) {
    const bool has_frames = file.is_group(object);
    return {has_frames ? object + "/value" : object, has_frames};
}

std::vector<double> read_lengths(const File& file, const std::string& object, const Shape& slice, bool all_frames,
                                 const std::optional<double>& length_unit) {
    const Element element = find_element(file, object);
    Shape expected = slice;
    if (element.has_frames) {
        const Shape found = file.shape(element.data);
        if (found.empty() || found[0] == 0) {
            file.fail(element.data, "has no frame");
        }
        expected.insert(expected.begin(), found[0]);
        require_frames(file, object, found[0]);
    }
    require_shape(file, element.data, expected);
    const bool last = element.has_frames && !all_frames;
    std::vector<double> values = last ? file.read_last<double>(element.data) : file.read<double>(element.data);
    const double divisor = per_metre(file, element.data, length_unit);
    for (double& value : values) {
        value /= divisor;
    }
    return values;
}

std::size_t number_of_particles(const File& file, const std::string& position) {
    const Element element = find_element(file, position);
    const Shape shape = file.shape(element.data);
    const std::size_t rank = element.has_frames ? 3 : 2;
    if (shape.size() != rank || shape.back() != 3) {
        file.fail(element.data, "has the shape " + shape_text(shape) + ", but [frames][particles][3] is expected");
    }
    if (shape[rank - 2] == 0) {
        file.fail(element.data, "has no particles");
    }
    if (shape[rank - 2] > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        file.fail(element.data, "has more than 2^31 - 1 particles");
    }
    return shape[rank - 2];
}

std::array<bool, 3> read_periodicity(const File& file, const std::string& box) {
    const auto boundary = file.texts_attribute(box, "boundary");
    if (boundary.size() != 3) {
        file.fail(box, "must have an attribute 'boundary' of three texts");
    }
    for (const std::string& axis : boundary) {
        if (axis != "periodic" && axis != "none") {
            file.fail(box, "has the boundary '" + axis + "', but each edge of a box is 'periodic' or 'none'");
        }
    }
    return {boundary[0] == "periodic", boundary[1] == "periodic", boundary[2] == "periodic"};
}

std::vector<Eigen::Matrix3d> read_edges(const File& file, const std::string& edges, bool all_frames,
                                        const std::optional<double>& length_unit) {
    const Element element = find_element(file, edges);
    const bool is_vector = file.shape(element.data).size() == (element.has_frames ? 2U : 1U);
    const auto values = read_lengths(file, edges, is_vector ? Shape{3} : Shape{3, 3}, all_frames, length_unit);
    std::vector<Eigen::Matrix3d> boxes;
    for (std::size_t begin = 0; begin < values.size(); begin += is_vector ? 3 : 9) {
        const double* first = values.data() + begin;
        const Eigen::Matrix3d matrix =
            is_vector ? Eigen::Matrix3d(Eigen::Vector3d::Map(first).asDiagonal()) : Eigen::Matrix3d(Eigen::Matrix3d::Map(first));
        if (!matrix.allFinite()) {
            file.fail(element.data, "has an edge that is not a finite number");
        }
        if (matrix.isDiagonal(0) && (matrix.diagonal().array() <= 0).any()) {
            file.fail(edges,
                      "has an edge of " + to_text(matrix.diagonal().minCoeff()) + " m, but edges must be finite and positive");
        }
        try {
            Cell::of_edges(Eigen::Vector3d::Zero(), matrix, {true, true, true});
        } catch (const std::invalid_argument& error) {
            file.fail(element.data, std::string("cannot be read: ") + error.what());
        }
        boxes.push_back(matrix);
    }
    return boxes;
}

std::vector<double> read_times(const File& file, const std::string& position, std::size_t frames) {
    std::vector<double> times;
    const std::string object = position + "/time";
    if (file.is_dataset(object) && file.shape(object) == Shape{frames} && file.attribute(object, "unit") == "s") {
        times = file.read<double>(object);
    }
    const bool usable = !times.empty() && std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); });
    for (std::size_t frame = 0; !usable && frame < frames; ++frame) {
        times.resize(frames);
        times[frame] = static_cast<double>(frame);
    }
    return times;
}

}  // namespace coagula::io::h5md
