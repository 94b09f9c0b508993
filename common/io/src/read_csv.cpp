// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/readable.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "csv_reader.hpp"

namespace coagula::io {

namespace {

/// A column of numbers and how many of its unit are in a metre, or in a second.
struct ScaledColumn {
    CsvReader::Column column;
    double divisor;
};

/// The heading that the user names for a quantity, or the first of `names` among the headings.
std::optional<CsvReader::Column> find_column(const CsvReader& table, const std::string& quantity,
                                             const std::vector<std::string>& names, const ImportOptions& options) {
    if (const auto chosen = options.columns.find(quantity); chosen != options.columns.end()) {
        const std::string wanted = lower_case(chosen->second);
        if (auto column = table.find(wanted)) {
            return column;
        }
        table.file().fail("there is no column '" + chosen->second + "', which --columns names for " + quantity +
                          "; the columns are " + list_of(table.names()) + did_you_mean(wanted, table.names()));
    }
    for (const std::string& name : names) {
        if (auto column = table.find(name)) {
            return column;
        }
    }
    return std::nullopt;
}

/// Pixels and voxels are no lengths: the user says what one is.
bool is_pixel(const std::string& unit) {
    static const std::vector<std::string> names = {"px", "pixel", "pixels", "voxel", "voxels", "vox"};
    return std::find(names.begin(), names.end(), lower_case(unit)) != names.end();
}

bool names_length(const CsvReader::Column& column) {
    return !column.unit.empty() && !is_pixel(column.unit);
}

double divisor_of(const CsvReader& table, const CsvReader::Column& column, const std::optional<double>& default_unit) {
    ImportOptions unit;
    if (!names_length(column)) {
        unit.length_unit = default_unit;
    }
    return per_metre(table.file(), "column " + column.name, names_length(column) ? column.unit : "", unit);
}

std::optional<double> unit_of_axis(const ImportOptions& options, int axis) {
    return options.axis_units ? std::optional((*options.axis_units)[axis]) : options.length_unit;
}

std::vector<ScaledColumn> find_centres(const CsvReader& table, const ImportOptions& options) {
    std::vector<ScaledColumn> columns;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        const auto column = find_column(table, name, {name}, options);
        if (!column) {
            table.file().fail("there is no column " + name + " among " + list_of(table.names()) +
                              "; the first line must be a header that names x, y and z, or give --columns " + name + "=HEADING");
        }
        columns.push_back({*column, divisor_of(table, *column, unit_of_axis(options, axis))});
    }
    return columns;
}

/// The radius, or the diameter with twice the divisor.
std::optional<ScaledColumn> find_radius(const CsvReader& table, const ImportOptions& options) {
    if (options.radius) {
        return std::nullopt;
    }
    for (const bool is_radius : {true, false}) {
        const auto column = is_radius ? find_column(table, "radius", {"radius", "rad", "r"}, options)
                                      : find_column(table, "diameter", {"diameter", "diam"}, options);
        if (!column) {
            continue;
        }
        if (!names_length(*column) && options.axis_units && !options.length_unit) {
            table.file().fail("column " + column->name +
                              " names no unit, and the axes have different ones: give its unit as the fourth of --length-unit");
        }
        return ScaledColumn{*column, (is_radius ? 1 : 2) * divisor_of(table, *column, options.length_unit)};
    }
    return std::nullopt;
}

/// A unit beside headings that all name another.
void refuse_ignored_unit(const CsvReader& table, const std::vector<ScaledColumn>& centres,
                         const std::optional<ScaledColumn>& radius, const ImportOptions& options) {
    const auto has_own = [](const ScaledColumn& scaled) { return names_length(scaled.column); };
    if (!std::all_of(centres.begin(), centres.end(), has_own) || (radius && !has_own(*radius))) {
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const ScaledColumn& centre = centres[static_cast<std::size_t>(axis)];
        const std::optional<double> unit = unit_of_axis(options, axis);
        if (unit && std::abs(*unit * centre.divisor - 1) > 1e-9) {
            table.file().fail("column " + centre.column.name + " has the unit '" + centre.column.unit +
                              "', but --length-unit says " + with_unit(*unit, "m") +
                              ": leave --length-unit out, or take the unit out of the heading");
        }
    }
}

/// The number of the frame of the present line.
std::int64_t frame_in(CsvReader& table, const CsvReader::Column& column) {
    const double value = table.number(column);
    if (value != std::nearbyint(value) || std::abs(value) > 1e15) {
        table.file().fail("column " + column.name + " has the frame " + to_text(value) + ", which is not a whole number");
    }
    return static_cast<std::int64_t>(value);
}

/// A column time with its unit.
std::optional<ScaledColumn> find_time(const CsvReader& table) {
    const auto column = table.find("time");
    if (!column || column->unit.empty()) {
        return std::nullopt;
    }
    try {
        return ScaledColumn{*column, unit_factor("s", column->unit)};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

std::vector<RawPacking> chosen_frames(const std::string& path, std::map<std::int64_t, RawPacking>& frames,
                                      const std::optional<CsvReader::Column>& column, const ImportOptions& options) {
    if (frames.size() > 1 && !options.frame) {
        throw InputError(path + " has " + std::to_string(frames.size()) + " frames, " + std::to_string(frames.begin()->first) +
                         " to " + std::to_string(frames.rbegin()->first) + " in column " + column->name +
                         ": choose one with --frame N, --frame first or --frame last, or take --frame all");
    }
    FrameCollector collector(options);
    for (auto& [number, raw] : frames) {
        collector.add(std::move(raw), number);
    }
    return collector.take(path);
}

}  // namespace

std::vector<RawPacking> read_csv(LineReader& file, const ImportOptions& options) {
    CsvReader table(file);
    const std::vector<ScaledColumn> centres = find_centres(table, options);
    const std::optional<ScaledColumn> radius = find_radius(table, options);
    refuse_ignored_unit(table, centres, radius, options);
    const auto frame = find_column(table, "frame", {"frame"}, options);
    if (!frame && options.frame) {
        file.fail("there is no column frame to choose by --frame; name it by --columns frame=HEADING");
    }
    const std::optional<ScaledColumn> time = frame ? find_time(table) : std::nullopt;
    std::map<std::int64_t, RawPacking> frames;
    while (table.next()) {
        RawPacking& raw = frames[frame ? frame_in(table, *frame) : 0];
        for (const ScaledColumn& centre : centres) {
            raw.coordinates.push_back(table.number(centre.column) / centre.divisor);
        }
        if (radius) {
            raw.radii.push_back(table.number(radius->column) / radius->divisor);
        }
        if (time && raw.lines.empty()) {
            raw.time = table.number(time->column) / time->divisor;
        }
        raw.lines.push_back(file.number());
    }
    return chosen_frames(file.path(), frames, frame, options);
}

}  // namespace coagula::io
