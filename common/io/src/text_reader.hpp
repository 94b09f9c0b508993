// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers of the text formats share: lines, numbers, and the way from raw columns to a checked packing.
#pragma once

#include <coagula/io/text_formats.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace coagula::io {

/// A text file in memory, read line by line; carriage returns and a byte order mark are dropped.
class LineReader {
public:
    /// Throws InputError when the file cannot be read.
    explicit LineReader(const std::string& path);

    /// Moves to the next line; false at the end.
    bool next();
    /// Moves to the next line that is not blank.
    bool next_filled();

    /// A place in the file to which a reader can return.
    struct Place {
        std::string_view rest;
        std::string_view line;
        std::size_t number = 0;
    };
    Place place() const { return {rest_, line_, number_}; }
    void return_to(const Place& place);

    std::string_view line() const { return line_; }
    std::size_t number() const { return number_; }
    const std::string& path() const { return path_; }

    /// Throws InputError "FILE, line N: rule".
    [[noreturn]] void fail(const std::string& rule) const;
    /// The whole field as a finite number; `what` names it in the error.
    double number_in(std::string_view field, std::string_view what) const;
    /// The whole field as an integer that is not negative.
    std::size_t count_in(std::string_view field, std::string_view what) const;

private:
    std::string path_;
    std::string contents_;
    std::string_view rest_;
    std::string_view line_;
    std::size_t number_ = 0;
};

/// The whole text as a number, which may be infinite; exponents begin with e or, as Fortran writes them, with d.
std::optional<double> read_number(std::string_view text);
/// The whole text as a number without a fraction, which may be negative.
bool is_whole_number(std::string_view text);

std::string_view trim(std::string_view text);
std::string lower_case(std::string_view text);
/// Words between blanks; a part in double quotes is not split.
std::vector<std::string_view> split_words(std::string_view line);

/// Coordinates as a file gave them, in metres.
struct RawPacking {
    std::size_t size() const { return coordinates.size() / 3; }
    /// "FILE, line 7: ", or "FILE, particle 7: " where there are no lines.
    std::string place(const std::string& path, std::size_t particle) const;

    std::vector<double> coordinates;  ///< x, y, z of each particle
    std::vector<double> radii;        ///< empty when the file names none
    std::vector<std::size_t> lines;   ///< where each particle stands
    std::optional<Cell> cell;         ///< when the file names one
    double time = unset;              ///< [s]
    double slack = 1e-9;              ///< of the edge: what the digits of the file leave out
};

/// How many of the unit that a column or file names are in a metre; for none the unit of the options. Throws InputError.
double per_metre(const LineReader& file, const std::string& object, const std::string& unit, const ImportOptions& options);

/// Brings particles into the order of their numbers. Throws InputError when one occurs twice.
void sort_by_number(const std::string& path, const std::vector<std::size_t>& numbers, RawPacking& raw);

/// Frames of a file that are asked for, in the order in which they are added.
class FrameCollector {
public:
    explicit FrameCollector(const ImportOptions& options) : choice_(options.frame.value_or(FrameChoice{})) {}
    /// @param number by which the user may name the frame.
    void add(RawPacking&& raw, std::int64_t number);
    /// Whether this one of `count` frames, numbered from 0, is asked for; one that is not may be passed over.
    bool wants(std::int64_t number, std::int64_t count) const;
    void pass_over(std::int64_t number);
    /// Throws InputError when the frame that is asked for is not there.
    std::vector<RawPacking> take(const std::string& path);

private:
    FrameChoice choice_;
    std::vector<RawPacking> kept_;
    std::int64_t first_ = 0;
    std::int64_t last_ = 0;
    std::size_t count_ = 0;
};

/// Applies the options (radius, box, open, wrap) and checks the packings. Throws InputError or std::invalid_argument.
Structure finish(const std::string& path, const std::vector<RawPacking>& frames, const ImportOptions& options);

/// Throws InputError when an option is given that belongs to another format than this one.
void refuse_options_of_other_formats(const std::string& path, const ImportOptions& options, std::optional<TextFormat> format);

std::vector<RawPacking> read_csv(LineReader& file, const ImportOptions& options);
std::vector<RawPacking> read_extended_xyz(LineReader& file, const ImportOptions& options);
std::vector<RawPacking> read_lammps_data(LineReader& file, const ImportOptions& options);
std::vector<RawPacking> read_lammps_dump(LineReader& file, const ImportOptions& options);

/// The unit of length of a style of LAMMPS units: "m" for "si"; empty for others than si, cgs, real, metal, micro, nano.
std::string length_unit_of(const std::string& lammps_units);

}  // namespace coagula::io
