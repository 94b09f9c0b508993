// An experiment file written from the exports of instruments: what each table is, its columns say.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/io/measured_file.hpp>

#include <optional>
#include <string>
#include <vector>

namespace coagula::tools {

/// Kind of a table of an export.
struct RecognisedTable {
    std::optional<diagnose::MeasurementKind> kind;  ///< none: nothing that a diagnosis could use
    std::string reason;                             ///< why, such as "angular_frequency goes from 0.1 to 100 rad/s"
};

/// By which column varies; a table that would not pass `--check` has no kind.
RecognisedTable recognise(const io::PlainTable& table, const std::string& label);

/// The quantities of its columns with numbers.
std::vector<std::string> understood(const io::PlainTable& table);

/// An export and what its tables are, one entry for each table that is no waveform.
struct RecognisedFile {
    io::MeasuredFile file;
    std::vector<RecognisedTable> tables;
};
RecognisedFile recognise(const std::string& path);

/// The commented experiment file. Paths are written relative to `folder`.
std::string new_experiment(const std::vector<RecognisedFile>& files, const std::string& folder);

}  // namespace coagula::tools
