// The text dump of LAMMPS (LAMMPS manual, "dump" and "dump_modify"), with one frame or many.
#include <algorithm>
#include <array>

#include "text_reader.hpp"

namespace coagula::io {

namespace {

/// What stands above the atoms of a frame.
struct FrameHeader {
    std::optional<std::size_t> atoms;
    double time = unset;
    Eigen::Vector3d lower = Eigen::Vector3d::Constant(unset);  // as the file has it
    Eigen::Vector3d upper = Eigen::Vector3d::Constant(unset);
    bool periodic = true;
};

/// Which words of an atom's line are what.
struct Columns {
    std::array<std::size_t, 3> position{};
    std::optional<std::size_t> number;
    std::optional<std::size_t> radius;
    bool is_diameter = false;
    bool scaled = false;
    std::size_t width = 0;
};

void next_line(LineReader& file, const char* what) {
    if (!file.next()) {
        file.fail(std::string("the file ends where ") + what + " should stand");
    }
}

bool parse_periodicity(const LineReader& file, const std::vector<std::string_view>& flags) {
    const auto is_periodic = [](std::string_view flag) { return flag == "pp"; };
    const auto count = std::count_if(flags.begin(), flags.end(), is_periodic);
    if (count != 0 && count != 3) {
        file.fail("the box is periodic along some axes only: coagula knows boxes that are periodic along all axes or along none");
    }
    return count == 3 || flags.empty();
}

void read_bounds(LineReader& file, std::vector<std::string_view> flags, FrameHeader& header) {
    const bool tilted = flags.size() >= 3 && (flags[0] == "xy" || flags[0] == "abc");
    if (tilted && flags[0] == "abc") {
        file.fail("the box is a general triclinic one, which coagula does not read");
    }
    flags.erase(flags.begin(), flags.begin() + (tilted ? 3 : 0));
    header.periodic = parse_periodicity(file, flags);
    for (int axis = 0; axis < 3; ++axis) {
        next_line(file, "the bounds of the box");
        const auto words = split_words(file.line());
        if (words.size() != (tilted ? 3U : 2U)) {
            file.fail("the bounds of the box must be two numbers");
        }
        if (tilted && file.number_in(words[2], "the tilt") != 0) {
            file.fail("this is a sheared box, which coagula does not read");
        }
        header.lower[axis] = file.number_in(words[0], "a bound of the box");
        header.upper[axis] = file.number_in(words[1], "a bound of the box");
        if (!(header.lower[axis] < header.upper[axis])) {
            file.fail("the box has an edge that is not positive");
        }
    }
}

Columns parse_columns(const LineReader& file, const std::vector<std::string_view>& names) {
    const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
        const auto found = std::find(names.begin(), names.end(), name);
        return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
    };
    Columns columns;
    columns.width = names.size();
    columns.number = find("id");
    columns.radius = find("radius");
    if (!columns.radius) {
        columns.radius = find("diameter");
        columns.is_diameter = columns.radius.has_value();
    }
    for (const char* ending : {"", "u", "s", "su"}) {
        const auto x = find(std::string("x") + ending);
        const auto y = find(std::string("y") + ending);
        const auto z = find(std::string("z") + ending);
        if (x && y && z) {
            columns.position = {*x, *y, *z};
            columns.scaled = ending[0] == 's';
            return columns;
        }
    }
    file.fail("the atoms have no columns x y z, xu yu zu, xs ys zs or xsu ysu zsu");
}

/// Positions count from the lower corner of a periodic box.
RawPacking read_atoms(LineReader& file, const FrameHeader& header, const Columns& columns, double divisor) {
    RawPacking raw;
    raw.time = header.time;
    const Eigen::Vector3d lengths = header.upper - header.lower;
    if (lengths.allFinite()) {
        raw.cell = header.periodic ? Cell::periodic(lengths / divisor) : Cell::open(header.lower / divisor, lengths / divisor);
    } else if (columns.scaled) {
        file.fail("the positions are scaled by a box that the frame does not have");
    }
    const Eigen::Vector3d corner = raw.cell && header.periodic ? header.lower : Eigen::Vector3d::Zero();
    std::vector<std::size_t> numbers;
    for (std::size_t atom = 0; atom < header.atoms.value_or(0); ++atom) {
        if (!file.next()) {
            file.fail("the file ends after " + std::to_string(atom) + " of " + std::to_string(*header.atoms) + " atoms");
        }
        const auto words = split_words(file.line());
        if (words.size() != columns.width) {
            file.fail("there are " + std::to_string(words.size()) + " columns, but " + std::to_string(columns.width) +
                      " are expected");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<Index>(axis);
            const double value = file.number_in(words[columns.position[axis]], "a coordinate");
            raw.coordinates.push_back(((columns.scaled ? header.lower[k] + value * lengths[k] : value) - corner[k]) / divisor);
        }
        if (columns.radius) {
            raw.radii.push_back((columns.is_diameter ? 0.5 : 1.0) * file.number_in(words[*columns.radius], "the radius") / divisor);
        }
        numbers.push_back(columns.number ? file.count_in(words[*columns.number], "the number of the atom") : atom);
        raw.lines.push_back(file.number());
    }
    sort_by_number(file.path(), numbers, raw);
    return raw;
}

}  // namespace

std::vector<RawPacking> read_lammps_dump(LineReader& file, const ImportOptions& options) {
    FrameCollector collector(options);
    std::string units;  // LAMMPS names them in the first frame only
    FrameHeader header;
    std::int64_t frame = 0;
    while (file.next_filled()) {
        const std::string line(file.line());
        if (!line.starts_with("ITEM: ")) {
            file.fail("'ITEM: ...' is expected; this is not a text dump of LAMMPS");
        }
        const std::string_view item = std::string_view(line).substr(6);
        if (item == "UNITS") {
            next_line(file, "the units");
            units = trim(file.line());
        } else if (item == "TIME") {
            next_line(file, "the time");
            const double time = file.number_in(file.line(), "the time");
            header.time = units == "si" || units == "cgs" ? time : unset;  // seconds in these
        } else if (item == "TIMESTEP") {
            next_line(file, "the time step");
        } else if (item == "NUMBER OF ATOMS") {
            next_line(file, "the number of atoms");
            header.atoms = file.count_in(trim(file.line()), "the number of atoms");
        } else if (item.starts_with("BOX BOUNDS")) {
            read_bounds(file, split_words(item.substr(10)), header);
        } else if (item.starts_with("ATOMS")) {
            if (!header.atoms) {
                file.fail("the frame names no number of atoms");
            }
            const double divisor = per_metre(file, "the file", length_unit_of(units), options);
            collector.add(read_atoms(file, header, parse_columns(file, split_words(item.substr(5))), divisor), frame++);
            header = {};
        } else {
            file.fail("'" + line + "' is not part of a dump of atoms");
        }
    }
    return collector.take(file.path());
}

}  // namespace coagula::io
