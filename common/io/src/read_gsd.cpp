#include <coagula/io/gsd_file.hpp>
#include <coagula/io/input_file.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <utility>

#include "gsd_layout.hpp"
#include "text_reader.hpp"

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

/// A GSD file in memory: its chunks by frame and name.
class GsdFile {
public:
    explicit GsdFile(const std::string& path) : path_(path), bytes_(read_file(path)) {
        read_header();
        read_names();
        read_index();
    }

    [[noreturn]] void fail(const std::string& what) const { throw InputError(path_ + ": " + what); }
    std::size_t size() const { return bytes_.size(); }
    std::uint64_t frames() const { return chunks_.empty() ? 0 : chunks_.rbegin()->first.first + 1; }

    /// The numbers of a chunk; empty where the frame has none of that name.
    std::vector<double> numbers(std::uint64_t frame, const std::string& name) const {
        const auto found = chunks_.find({frame, name});
        if (found == chunks_.end()) {
            return {};
        }
        const Entry& entry = found->second;
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

private:
    /// `count` things of `size` bytes from `location` on lie in the file.
    bool holds(std::uint64_t location, std::uint64_t count, std::uint64_t size) const {
        return location <= bytes_.size() && count <= (bytes_.size() - location) / size;
    }

    void read_header() {
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
        if (!holds(header_.names_location, header_.names_allocated, gsd::name_slot) ||
            !holds(header_.index_location, header_.index_allocated, sizeof(Entry))) {
            fail("the file is cut off or damaged: its index lies outside of it");
        }
    }

    /// In version 1 every name has a slot, in version 2 they follow each other.
    void read_names() {
        const bool slots = header_.version >> 16U == 1;
        std::string_view rest(bytes_.data() + header_.names_location,
                              static_cast<std::size_t>(header_.names_allocated) * gsd::name_slot);
        while (!rest.empty() && rest[0] != '\0') {
            const std::string_view slot = slots ? rest.substr(0, gsd::name_slot) : rest;
            names_.emplace_back(slot.substr(0, slot.find('\0')));
            rest.remove_prefix(slots ? gsd::name_slot : std::min(rest.size(), names_.back().size() + 1));
        }
    }

    void read_index() {
        static constexpr std::array<std::uint64_t, 11> sizes = {0, 1, 2, 4, 8, 1, 2, 4, 8, 4, 8};
        for (std::uint64_t k = 0; k < header_.index_allocated; ++k) {
            Entry entry{};
            std::memcpy(&entry, bytes_.data() + header_.index_location + k * sizeof(Entry), sizeof(Entry));
            if (entry.location == 0) {
                break;
            }
            if (entry.name >= names_.size() || entry.type == 0 || entry.type >= sizes.size() || entry.location < 0) {
                fail("the file is damaged: entry " + std::to_string(k) + " of its index is not a chunk");
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

    std::string path_;
    std::string bytes_;
    Header header_{};
    std::vector<std::string> names_;
    std::map<std::pair<std::uint64_t, std::string>, Entry> chunks_;
};

/// One number of the first frame, `otherwise` without it.
double number_of_file(const GsdFile& file, const std::string& name, double otherwise) {
    const std::vector<double> found = file.numbers(0, name);
    return found.size() == 1 ? found[0] : otherwise;
}

/// What a frame does not have it takes from the first one, if that has as many particles.
std::vector<double> values_of(const GsdFile& file, std::uint64_t frame, const std::string& name, std::size_t count,
                              std::size_t columns) {
    std::vector<double> values = file.numbers(frame, name);
    if (values.empty()) {
        values = file.numbers(0, name);
        if (values.size() != count * columns) {
            return {};
        }
    }
    if (values.size() != count * columns) {
        file.fail("'" + name + "' of frame " + std::to_string(frame) + " has " + std::to_string(values.size()) + " numbers, but " +
                  std::to_string(count * columns) + " are expected");
    }
    for (const double value : values) {
        if (!std::isfinite(value)) {
            file.fail("'" + name + "' of frame " + std::to_string(frame) + " has a number that is not finite");
        }
    }
    return values;
}

Cell cell_of(const GsdFile& file, std::uint64_t frame, double metres, bool periodic) {
    const std::vector<double> box = values_of(file, frame, "configuration/box", 1, 6);
    if (box.empty()) {
        file.fail("frame " + std::to_string(frame) + " has no box of six numbers");
    }
    if (box[3] != 0 || box[4] != 0 || box[5] != 0) {
        file.fail("the box of frame " + std::to_string(frame) + " is sheared, which coagula does not read");
    }
    const Eigen::Vector3d lengths = Eigen::Vector3d(box[0], box[1], box[2]) * metres;
    for (const double length : lengths) {
        if (!(std::isfinite(length) && length > 0)) {
            file.fail("the box of frame " + std::to_string(frame) + " has an edge that is not positive");
        }
    }
    return periodic ? Cell::periodic(lengths) : Cell::open(-0.5 * lengths, lengths);
}

RawPacking read_frame(const GsdFile& file, std::uint64_t frame, double metres, bool periodic) {
    std::vector<double> number = file.numbers(frame, "particles/N");
    if (number.empty()) {
        number = file.numbers(0, "particles/N");
    }
    if (number.size() != 1 || !(number[0] > 0)) {
        file.fail("frame " + std::to_string(frame) + " has no particles");
    }
    if (number[0] > static_cast<double>(file.size())) {
        file.fail("frame " + std::to_string(frame) + " has more particles than the file has bytes");
    }
    const auto count = static_cast<std::size_t>(number[0]);
    RawPacking raw;
    raw.slack = 1e-6;  // single precision
    raw.cell = cell_of(file, frame, metres, periodic);
    raw.coordinates = values_of(file, frame, "particles/position", count, 3);
    if (raw.coordinates.empty()) {
        file.fail("frame " + std::to_string(frame) + " has no 'particles/position'");
    }
    const Eigen::Vector3d corner = periodic ? Eigen::Vector3d(0.5 * raw.cell->lengths()) : Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < raw.coordinates.size(); ++i) {
        raw.coordinates[i] = raw.coordinates[i] * metres + corner[static_cast<Index>(i % 3)];
    }
    const std::vector<double> diameters = values_of(file, frame, "particles/diameter", count, 1);
    raw.radii.assign(count, 0.5 * metres);  // the default of the schema, which is not stored
    std::transform(diameters.begin(), diameters.end(), raw.radii.begin(), [&](double value) { return 0.5 * value * metres; });
    const std::vector<double> time = file.numbers(frame, "log/coagula/time");
    raw.time = time.size() == 1 && std::isfinite(time[0]) ? time[0] : unset;
    return raw;
}

}  // namespace

Structure read_gsd(const std::string& path, const ImportOptions& options) {
    if (options.axis_units || !options.columns.empty()) {
        throw InputError(path + " is no CSV file: --columns and units of single axes are for these");
    }
    const GsdFile file(path);
    const double named = number_of_file(file, "log/coagula/length_unit", unset);
    const double metres = options.length_unit.value_or(named);
    if (std::isnan(metres)) {
        file.fail("GSD names no unit of length: give --length-unit");
    }
    const bool periodic = number_of_file(file, "log/coagula/periodic", 1) != 0 && !options.open;
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
            RawPacking raw = read_frame(file, static_cast<std::uint64_t>(frame), metres, periodic);
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
