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

std::string_view trim(std::string_view text);
std::string lower_case(std::string_view text);
/// Words between blanks; a part in double quotes is not split.
std::vector<std::string_view> split_words(std::string_view line);

/// Coordinates as a file gave them, in metres.
struct RawPacking {
    std::vector<double> coordinates;  ///< x, y, z of each particle
    std::vector<double> radii;        ///< empty when the file names none
    std::vector<std::size_t> lines;   ///< where each particle stands
    std::optional<Cell> cell;         ///< when the file names one
};

/// How many of the unit that a column or file names are in a metre; for none the unit of the options. Throws InputError.
double per_metre(const LineReader& file, const std::string& object, const std::string& unit, const ImportOptions& options);

/// Applies the options (radius, box, open, wrap) and checks the packing. Throws InputError or std::invalid_argument.
Packing finish(const std::string& path, const RawPacking& raw, const ImportOptions& options);

RawPacking read_csv(LineReader& file, const ImportOptions& options);
RawPacking read_extended_xyz(LineReader& file, const ImportOptions& options);
RawPacking read_lammps_data(LineReader& file, const ImportOptions& options);

}  // namespace coagula::io
