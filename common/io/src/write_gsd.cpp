// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/gsd_file.hpp>

#include <cstring>
#include <string_view>
#include <type_traits>

#include "gsd_layout.hpp"
#include "triclinic.hpp"

namespace coagula::io {

namespace {

using gsd::Entry;
using gsd::Header;
using gsd::Type;

template <class T>
constexpr Type type_of() {
    if constexpr (std::is_same_v<T, double>) {
        return Type::f64;
    } else if constexpr (std::is_same_v<T, float>) {
        return Type::f32;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
        return Type::u64;
    } else if constexpr (std::is_same_v<T, std::uint32_t>) {
        return Type::u32;
    } else if constexpr (std::is_same_v<T, std::int8_t>) {
        return Type::i8;
    } else {
        return Type::u8;
    }
}

/// Header, chunks, index and names, in this order. Entries of the index are sorted by frame and name, as version 2 wants them.
class GsdBytes {
public:
    GsdBytes() : bytes_(sizeof(Header), '\0') {}

    template <class T>
    void add(std::uint64_t frame, const std::string& name, const std::vector<T>& values, std::uint32_t columns = 1) {
        const auto location = static_cast<std::int64_t>(bytes_.size());
        index_.push_back(
            {frame, values.size() / columns, location, columns, number_of(name), static_cast<std::uint8_t>(type_of<T>()), 0});
        append(values.data(), values.size() * sizeof(T));
    }

    std::string take() {
        std::stable_sort(index_.begin(), index_.end(),
                         [](const Entry& a, const Entry& b) { return std::pair(a.frame, a.name) < std::pair(b.frame, b.name); });
        Header header{};
        header.magic = gsd::magic;
        header.index_location = bytes_.size();
        header.index_allocated = index_.size() + 1;  // an empty one ends them
        index_.push_back({});
        append(index_.data(), index_.size() * sizeof(Entry));
        std::string names;
        for (const std::string& name : names_) {
            names += name + '\0';
        }
        header.names_location = bytes_.size();
        header.names_allocated = names.size() / gsd::name_slot + 1;
        names.resize(static_cast<std::size_t>(header.names_allocated) * gsd::name_slot, '\0');
        append(names.data(), names.size());
        header.schema_version = (1U << 16U) | 4U;
        header.version = 2U << 16U;
        std::string_view("coagula").copy(header.application.data(), header.application.size());
        std::string_view("hoomd").copy(header.schema.data(), header.schema.size());
        std::memcpy(bytes_.data(), &header, sizeof(Header));
        return std::move(bytes_);
    }

private:
    void append(const void* values, std::size_t size) { bytes_.append(static_cast<const char*>(values), size); }

    std::uint16_t number_of(const std::string& name) {
        const auto found = std::find(names_.begin(), names_.end(), name);
        const auto number = static_cast<std::uint16_t>(found - names_.begin());
        if (found == names_.end()) {
            names_.push_back(name);
        }
        return number;
    }

    std::string bytes_;
    std::vector<Entry> index_;
    std::vector<std::string> names_;
};

/// Positions count from the middle of the box, and lie in it after rounding, too.
std::vector<float> centred(const Packing& packing, const Eigen::Matrix3Xd& positions) {
    const Cell& cell = packing.cell;
    const Eigen::Vector3d middle = cell.centre();
    std::vector<float> values;
    values.reserve(static_cast<std::size_t>(positions.size()));
    for (Index particle = 0; particle < positions.cols(); ++particle) {
        const Eigen::Vector3d place = cell.wrap(positions.col(particle));
        for (int axis = 0; axis < 3; ++axis) {
            const auto half = static_cast<float>(0.5 * cell.edges()(axis, axis));
            const auto value = static_cast<float>(place[axis] - middle[axis]);
            const bool beyond = cell.is_rectangular() && cell.is_periodic(axis) && value >= half;
            values.push_back(beyond ? -half : value);
        }
    }
    return values;
}

/// What is the same in all frames stands in the first one only, as the schema has it.
void add_constants(GsdBytes& file, const Packing& packing) {
    const Eigen::Matrix3d& edges = packing.cell.edges();
    const Eigen::Vector3f box = edges.diagonal().cast<float>();
    const Eigen::Vector3f tilt =
        Eigen::Vector3d(edges(0, 1) / edges(1, 1), edges(0, 2) / edges(2, 2), edges(1, 2) / edges(2, 2)).cast<float>();
    std::vector<float> diameters;
    for (const double radius : packing.radii) {
        diameters.push_back(static_cast<float>(2 * radius));
    }
    file.add<std::uint8_t>(0, "configuration/dimensions", {3});
    file.add<float>(0, "configuration/box", {box[0], box[1], box[2], tilt[0], tilt[1], tilt[2]});
    file.add<std::uint32_t>(0, "particles/N", {static_cast<std::uint32_t>(packing.size())});
    file.add<std::int8_t>(0, "particles/types", {'A', '\0'}, 2);
    file.add(0, "particles/diameter", diameters);
    file.add<double>(0, "log/coagula/length_unit", {1.0});
    std::vector<std::uint8_t> periodic;
    for (int axis = 0; axis < 3; ++axis) {
        periodic.push_back(packing.cell.is_periodic(axis) ? 1 : 0);
    }
    const bool alike = packing.cell.is_periodic() || packing.cell.is_open();
    file.add<std::uint8_t>(0, "log/coagula/periodic", alike ? std::vector<std::uint8_t>{periodic[0]} : periodic);
}

}  // namespace

void write_gsd(const std::string& path, const Structure& structure, bool overwrite) {
    check_output(path, overwrite);
    check(structure.packing);
    require_restricted(path, structure.packing.cell);
    GsdBytes file;
    add_constants(file, structure.packing);
    const std::size_t frames = structure.earlier.size() + 1;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const bool last = frame + 1 == frames;
        file.add<std::uint64_t>(frame, "configuration/step", {frame});
        file.add(frame, "particles/position",
                 centred(structure.packing, last ? structure.packing.positions : structure.earlier[frame].positions), 3);
        file.add<double>(frame, "log/coagula/time", {last ? structure.time : structure.earlier[frame].time});
    }
    write_file(path, file.take(), overwrite);
}

}  // namespace coagula::io
