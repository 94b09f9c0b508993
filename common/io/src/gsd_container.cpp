// SPDX-License-Identifier: GPL-3.0-or-later
#include "gsd_container.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/input_file.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

namespace coagula::io {

namespace {

using gsd::Entry;
using gsd::Header;
using gsd::Type;

static_assert(std::endian::native == std::endian::little, "GSD files are little-endian");

/// The numbers of one type as doubles.
template <class T>
std::vector<double> widened(const char* bytes, std::size_t count) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) {
        T value{};
        std::memcpy(&value, bytes + i * sizeof(T), sizeof(T));
        values[i] = static_cast<double>(value);
    }
    return values;
}

}  // namespace

GsdFile::GsdFile(const std::string& path) : path_(path), bytes_(read_file(path)) {
    read_header();
    read_names();
    read_index();
}

void GsdFile::fail(const std::string& what) const {
    throw InputError(path_ + ": " + what);
}

const Entry* GsdFile::find(std::uint64_t frame, const std::string& name) const {
    const auto found = chunks_.find({frame, name});
    return found == chunks_.end() ? nullptr : &found->second;
}

std::vector<double> GsdFile::numbers(std::uint64_t frame, const std::string& name) const {
    const Entry* found = find(frame, name);
    if (found == nullptr) {
        return {};
    }
    const Entry& entry = *found;
    const char* begin = bytes_.data() + entry.location;
    const auto count = static_cast<std::size_t>(entry.rows * entry.columns);
    switch (static_cast<Type>(entry.type)) {
        case Type::u8:
            return widened<std::uint8_t>(begin, count);
        case Type::u16:
            return widened<std::uint16_t>(begin, count);
        case Type::u32:
            return widened<std::uint32_t>(begin, count);
        case Type::u64:
            return widened<std::uint64_t>(begin, count);
        case Type::i8:
            return widened<std::int8_t>(begin, count);
        case Type::i16:
            return widened<std::int16_t>(begin, count);
        case Type::i32:
            return widened<std::int32_t>(begin, count);
        case Type::i64:
            return widened<std::int64_t>(begin, count);
        case Type::f32:
            return widened<float>(begin, count);
        case Type::f64:
            return widened<double>(begin, count);
    }
    fail("'" + name + "' is of a type that GSD does not have");
}

std::vector<double> GsdFile::numbers_or_first(std::uint64_t frame, const std::string& name) const {
    std::vector<double> found = numbers(frame, name);
    return found.empty() ? numbers(0, name) : found;
}

std::vector<double> GsdFile::values(std::uint64_t frame, const std::string& name, std::size_t rows, std::size_t columns) const {
    const bool own = find(frame, name) != nullptr;
    std::vector<double> values = numbers_or_first(frame, name);
    if (!own && values.size() != rows * columns) {
        return {};
    }
    if (values.size() != rows * columns) {
        fail("'" + name + "' of frame " + std::to_string(frame) + " has " + std::to_string(values.size()) + " numbers, but " +
             std::to_string(rows * columns) + " are expected");
    }
    for (const double value : values) {
        if (!std::isfinite(value)) {
            fail("'" + name + "' of frame " + std::to_string(frame) + " has a number that is not finite");
        }
    }
    return values;
}

std::vector<std::string> GsdFile::texts_or_first(std::uint64_t frame, const std::string& name) const {
    const Entry* found = find(frame, name);
    found = found == nullptr ? find(0, name) : found;
    std::vector<std::string> texts;
    if (found == nullptr) {
        return texts;
    }
    if (found->type != static_cast<std::uint8_t>(Type::i8) && found->type != static_cast<std::uint8_t>(Type::u8)) {
        fail("'" + name + "' of frame " + std::to_string(frame) + " is not text");
    }
    for (std::uint64_t row = 0; row < found->rows; ++row) {
        const std::string_view bytes(bytes_.data() + found->location + row * found->columns, found->columns);
        texts.emplace_back(bytes.substr(0, bytes.find('\0')));
    }
    return texts;
}

/// Whether `count` things of `size` bytes from `location` on lie in the file.
bool GsdFile::holds(std::uint64_t location, std::uint64_t count, std::uint64_t size) const {
    return location <= bytes_.size() && count <= (bytes_.size() - location) / size;
}

void GsdFile::read_header() {
    if (bytes_.size() < sizeof(Header)) {
        fail("the file is too short for GSD");
    }
    std::memcpy(&header_, bytes_.data(), sizeof(Header));
    if (header_.magic != gsd::magic) {
        fail("the file is no GSD");
    }
    const std::uint32_t major = header_.version >> 16U;
    if (major != 1 && major != 2) {
        fail("the file has version " + std::to_string(major) + " of GSD, but coagula reads 1 and 2");
    }
    if (std::strncmp(header_.schema.data(), "hoomd", header_.schema.size()) != 0) {
        fail("the file does not have the schema 'hoomd'");
    }
    if (const std::uint32_t schema = header_.schema_version >> 16U; schema != 1) {
        fail("the file has version " + std::to_string(schema) + " of the schema hoomd, but coagula reads 1");
    }
    if (!holds(header_.names_location, header_.names_allocated, gsd::name_slot) ||
        !holds(header_.index_location, header_.index_allocated, sizeof(Entry))) {
        fail("the file is cut off or damaged: its index lies outside of it");
    }
}

/// In version 1 every name has a slot, in version 2 they follow each other.
void GsdFile::read_names() {
    const bool slots = header_.version >> 16U == 1;
    std::string_view rest(bytes_.data() + header_.names_location,
                          static_cast<std::size_t>(header_.names_allocated) * gsd::name_slot);
    while (!rest.empty() && rest[0] != '\0') {
        const std::string_view slot = slots ? rest.substr(0, gsd::name_slot) : rest;
        names_.emplace_back(slot.substr(0, slot.find('\0')));
        rest.remove_prefix(slots ? gsd::name_slot : std::min(rest.size(), names_.back().size() + 1));
    }
}

void GsdFile::read_index() {
    static constexpr std::array<std::uint64_t, 11> sizes = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
    for (std::uint64_t k = 0; k < header_.index_allocated; ++k) {
        Entry entry{};
        std::memcpy(&entry, bytes_.data() + header_.index_location + k * sizeof(Entry), sizeof(Entry));
        if (entry.location == 0) {
            break;
        }
        if (entry.name >= names_.size() || entry.type == 0 || entry.type >= sizes.size() || entry.location < 0) {
            fail("the file is damaged: entry " + std::to_string(k) + " of its index is no chunk");
        }
        const std::uint64_t row = sizes[entry.type] * entry.columns;
        if (row > 0 && !holds(static_cast<std::uint64_t>(entry.location), entry.rows, row)) {
            fail("the file is cut off or damaged: '" + names_[entry.name] + "' of frame " + std::to_string(entry.frame) +
                 " lies outside of it");
        }
        if (row == 0 || entry.frame > header_.index_allocated) {  // no frame is without an entry of its own
            fail("the file is damaged: '" + names_[entry.name] + "' is empty or of a frame that is not there");
        }
        chunks_[{entry.frame, names_[entry.name]}] = entry;
    }
}

}  // namespace coagula::io
