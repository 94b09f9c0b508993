#include <array>
#include <map>

#include "text_reader.hpp"

namespace coagula::io {

namespace {

std::string_view without_quotes(std::string_view text) {
    return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// The key=value pairs of the comment line; keys in lower case.
std::map<std::string, std::string> parse_comment(std::string_view line) {
    std::map<std::string, std::string> pairs;
    for (const std::string_view word : split_words(line)) {
        const std::size_t equals = word.find('=');
        if (equals != std::string_view::npos) {
            pairs[lower_case(word.substr(0, equals))] = without_quotes(word.substr(equals + 1));
        }
    }
    return pairs;
}

std::string value_of(const std::map<std::string, std::string>& pairs, const std::string& key) {
    const auto found = pairs.find(key);
    return found == pairs.end() ? "" : found->second;
}

/// Which words of a particle's line are the position and the radius.
struct Layout {
    std::optional<std::size_t> position;
    std::optional<std::size_t> radius;
    bool is_diameter = false;
    std::size_t width = 0;
};

constexpr std::size_t most_columns = 1000;  ///< of a property

/// Properties=species:S:1:pos:R:3:radius:R:1; plain XYZ is species and position.
Layout parse_properties(const LineReader& file, const std::string& properties) {
    if (properties.empty()) {
        return {1, std::nullopt, false, 4};
    }
    std::vector<std::string> parts(1);
    for (const char c : properties) {
        if (c == ':') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    if (parts.size() % 3 != 0) {
        file.fail("Properties must be triples name:type:columns");
    }
    Layout layout;
    for (std::size_t i = 0; i < parts.size(); i += 3) {
        const std::string name = lower_case(parts[i]);
        const std::size_t columns = file.count_in(parts[i + 2], "the number of columns of " + parts[i]);
        if (columns > most_columns) {
            file.fail("the number of columns of " + parts[i] + " is " + parts[i + 2] + ", but must be at most " +
                      std::to_string(most_columns));
        }
        if (name == "pos" && columns == 3) {
            layout.position = layout.width;
        } else if ((name == "radius" || name == "radii") && columns == 1) {
            layout.radius = layout.width;
            layout.is_diameter = false;
        } else if (name == "diameter" && columns == 1 && !layout.radius) {
            layout.radius = layout.width;
            layout.is_diameter = true;
        }
        layout.width += columns;
    }
    if (!layout.position) {
        file.fail("Properties name no pos:R:3");
    }
    return layout;
}

bool parse_periodicity(const LineReader& file, const std::string& text) {
    const auto flags = split_words(text);
    if (flags.empty()) {
        return true;
    }
    for (const std::string_view flag : flags) {
        if (flags.size() != 3 || (flag != "T" && flag != "F") || flag != flags[0]) {
            file.fail("pbc must be \"T T T\" or \"F F F\": coagula knows boxes that are periodic along all axes or along none");
        }
    }
    return flags[0] == "T";
}

std::optional<Cell> parse_cell(const LineReader& file, const std::map<std::string, std::string>& pairs, double divisor) {
    const std::string lattice = value_of(pairs, "lattice");
    const auto entries = split_words(lattice);
    if (entries.empty()) {
        return std::nullopt;
    }
    if (entries.size() != 9) {
        file.fail("Lattice must have nine numbers");
    }
    Eigen::Vector3d lengths;
    for (int i = 0; i < 9; ++i) {
        const double entry = file.number_in(entries[static_cast<std::size_t>(i)], "an entry of Lattice") / divisor;
        if (i % 4 == 0) {
            lengths[i / 4] = require_positive(entry, "the edge length in Lattice", "m");
        } else if (entry != 0) {
            file.fail("Lattice is a sheared box, which coagula does not read");
        }
    }
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const std::string origin_text = value_of(pairs, "origin");
    const auto coordinates = split_words(origin_text);
    for (std::size_t axis = 0; axis < 3 && coordinates.size() == 3; ++axis) {
        origin[static_cast<Index>(axis)] = file.number_in(coordinates[axis], "Origin") / divisor;
    }
    if (parse_periodicity(file, value_of(pairs, "pbc"))) {
        if (!origin.isZero(0)) {
            file.fail("a periodic box must begin at the origin");
        }
        return Cell::periodic(lengths);
    }
    return Cell::open(origin, lengths);
}

void read_particle(const LineReader& file, const Layout& layout, double divisor, RawPacking& raw) {
    const auto words = split_words(file.line());
    if (words.size() < layout.width) {
        file.fail("there are " + std::to_string(words.size()) + " columns, but " + std::to_string(layout.width) + " are expected");
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        raw.coordinates.push_back(file.number_in(words[*layout.position + axis], "a coordinate") / divisor);
    }
    if (layout.radius) {
        raw.radii.push_back((layout.is_diameter ? 0.5 : 1.0) * file.number_in(words[*layout.radius], "the radius") / divisor);
    }
    raw.lines.push_back(file.number());
}

RawPacking read_frame(LineReader& file, const ImportOptions& options) {
    const std::size_t particles = file.count_in(trim(file.line()), "the number of particles");
    if (!file.next()) {
        file.fail("the comment line is missing");
    }
    const auto pairs = parse_comment(file.line());
    const double divisor = per_metre(file, "the comment line", value_of(pairs, "length_unit"), options);
    const Layout layout = parse_properties(file, value_of(pairs, "properties"));
    RawPacking raw;
    raw.cell = parse_cell(file, pairs, divisor);
    if (const std::string time = value_of(pairs, "time"); !time.empty()) {
        raw.time = file.number_in(time, "Time");
    }
    for (std::size_t particle = 0; particle < particles; ++particle) {
        if (!file.next()) {
            file.fail("the file ends after " + std::to_string(particle) + " of " + std::to_string(particles) + " particles");
        }
        read_particle(file, layout, divisor, raw);
    }
    return raw;
}

}  // namespace

std::vector<RawPacking> read_extended_xyz(LineReader& file, const ImportOptions& options) {
    FrameCollector collector(options);
    for (std::int64_t frame = 0; file.next_filled(); ++frame) {
        collector.add(read_frame(file, options), frame);
    }
    return collector.take(file.path());
}

}  // namespace coagula::io
