#include "text_reader.hpp"

#include <coagula/io/input_file.hpp>
#include <coagula/io/units.hpp>

#include <cctype>
#include <charconv>
#include <cmath>

namespace coagula::io {

namespace {

std::string particle_line(const std::string& path, const RawPacking& raw, std::size_t particle) {
    return path + ", line " + std::to_string(raw.lines[particle]) + ": ";
}

Eigen::VectorXd radii_of(const std::string& path, const RawPacking& raw, const ImportOptions& options) {
    const auto particles = static_cast<Index>(raw.lines.size());
    if (options.radius) {
        return Eigen::VectorXd::Constant(particles, require_positive(*options.radius, "the radius", "m"));
    }
    if (raw.radii.empty()) {
        throw InputError(path + " names no radii: give --radius (or a column 'radius')");
    }
    for (std::size_t particle = 0; particle < raw.radii.size(); ++particle) {
        if (!(raw.radii[particle] > 0)) {
            throw InputError(particle_line(path, raw, particle) + "the radius is " + to_text(raw.radii[particle]) +
                             " m, but must be positive");
        }
    }
    return Eigen::VectorXd::Map(raw.radii.data(), particles);
}

/// The box around the spheres; a given size is centred on them.
Cell open_cell(const Eigen::Matrix3Xd& positions, const Eigen::VectorXd& radii, const std::optional<Eigen::Vector3d>& size) {
    const Eigen::Vector3d lower = (positions.rowwise() - radii.transpose()).rowwise().minCoeff();
    const Eigen::Vector3d upper = (positions.rowwise() + radii.transpose()).rowwise().maxCoeff();
    return size ? Cell::open(0.5 * (lower + upper - *size), *size) : Cell::open(lower, upper - lower);
}

Cell cell_of(const std::string& path, const RawPacking& raw, const Packing& packing, const ImportOptions& options) {
    if (options.open) {
        const bool sized_by_file = !options.box && raw.cell && !raw.cell->is_periodic();
        return sized_by_file ? *raw.cell : open_cell(packing.positions, packing.radii, options.box);
    }
    if (options.box) {
        return Cell::periodic(*options.box);
    }
    if (!raw.cell) {
        throw InputError(path + " names no box: give --box for a periodic one or --open for a set with a free surface");
    }
    return raw.cell->is_periodic() ? Cell::periodic(raw.cell->lengths()) : *raw.cell;
}

/// Brings positions into the periodic box; more than a rounding outside is an error unless asked for.
void wrap_positions(const std::string& path, const RawPacking& raw, Packing& packing, bool wrap) {
    constexpr double slack = 1e-9;  // of the edge: what the digits of a text file leave out
    const Eigen::Vector3d lengths = packing.cell.lengths();
    for (Index particle = 0; particle < packing.size(); ++particle) {
        const Eigen::Vector3d position = packing.positions.col(particle);
        for (int axis = 0; axis < 3 && !wrap; ++axis) {
            const double relative = position[axis] / lengths[axis];
            if (!(relative >= -slack && relative <= 1 + slack)) {
                throw InputError(particle_line(path, raw, static_cast<std::size_t>(particle)) + "xyz"[axis] + " is " +
                                 to_text(position[axis]) + " m, outside the periodic box from 0 to " + to_text(lengths[axis]) +
                                 " m; give --wrap to bring such particles back in");
            }
        }
        packing.positions.col(particle) = packing.cell.wrap(position);
    }
}

}  // namespace

LineReader::LineReader(const std::string& path) : path_(path), contents_(read_file(path)) {
    rest_ = contents_;
    if (rest_.starts_with("\xef\xbb\xbf")) {
        rest_.remove_prefix(3);
    }
    if (contents_.find('\0') != std::string::npos) {
        throw InputError(path + " is not a text file");
    }
}

bool LineReader::next() {
    if (rest_.empty()) {
        return false;
    }
    const std::size_t end = rest_.find('\n');
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line_.ends_with('\r')) {
        line_.remove_suffix(1);
    }
    ++number_;
    return true;
}

bool LineReader::next_filled() {
    while (next()) {
        if (!trim(line_).empty()) {
            return true;
        }
    }
    return false;
}

void LineReader::fail(const std::string& rule) const {
    throw InputError(path_ + ", line " + std::to_string(number_) + ": " + rule);
}

double LineReader::number_in(std::string_view field, std::string_view what) const {
    field = trim(field);
    std::string_view digits = field;
    if (digits.starts_with('+') && !digits.starts_with("+-")) {
        digits.remove_prefix(1);
    }
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
        fail(std::string(what) + " is '" + std::string(field) + "', which is not a number");
    }
    if (!std::isfinite(value)) {
        fail(std::string(what) + " is '" + std::string(field) + "', but must be finite");
    }
    return value;
}

std::size_t LineReader::count_in(std::string_view field, std::string_view what) const {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
        fail(std::string(what) + " is '" + std::string(field) + "', which is not a whole number");
    }
    return value;
}

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return lower;
}

std::vector<std::string_view> split_words(std::string_view line) {
    std::vector<std::string_view> words;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= line.size(); ++i) {
        const bool at_end = i == line.size();
        if (!at_end && line[i] == '"') {
            quoted = !quoted;
        }
        if (at_end || (!quoted && (line[i] == ' ' || line[i] == '\t'))) {
            if (i > begin) {
                words.push_back(line.substr(begin, i - begin));
            }
            begin = i + 1;
        }
    }
    return words;
}

double per_metre(const LineReader& file, const std::string& object, const std::string& unit, const ImportOptions& options) {
    if (unit.empty()) {
        if (!options.length_unit) {
            file.fail(object + " names no unit: give --length-unit");
        }
        return 1 / require_positive(*options.length_unit, "the length unit", "m");
    }
    try {
        return unit_factor("m", unit);
    } catch (const std::exception&) {
        file.fail(object + " has the unit '" + unit + "', which is not a length");
    }
}

Packing finish(const std::string& path, const RawPacking& raw, const ImportOptions& options) {
    if (raw.lines.empty()) {
        throw InputError(path + " has no particles");
    }
    Packing packing;
    packing.positions = Eigen::Matrix3Xd::Map(raw.coordinates.data(), 3, static_cast<Index>(raw.lines.size()));
    packing.radii = radii_of(path, raw, options);
    packing.cell = cell_of(path, raw, packing, options);
    if (packing.cell.is_periodic()) {
        wrap_positions(path, raw, packing, options.wrap);
    }
    check(packing, path);
    if (const double fraction = volume_fraction(packing); fraction > 1) {
        throw InputError(path + " is overfull: its spheres take " + to_text(fraction) + " of the volume of the box");
    }
    return packing;
}

}  // namespace coagula::io
