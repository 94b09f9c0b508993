// SPDX-License-Identifier: GPL-3.0-or-later
// The table of measures: what can be measured of a packing, with the options, results and words of each. The program, its help
// text, the file and the JSON object follow from it. docs/development/architecture.md says how a measure is added.
#pragma once

#include <coagula/characterize/applicable.hpp>
#include <coagula/characterize/measure_input.hpp>
#include <coagula/common/dataset.hpp>
#include <coagula/common/readable.hpp>

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::characterize {

/// An option of a measure. Measures that share an option (the tolerance of contacts) take it from measure_options.hpp.
struct MeasureOption {
    std::string name;                     ///< without dashes, "contact-tolerance"
    std::string unit;                     ///< UDUNITS text of a quantity; empty: a whole number
    std::string meaning;                  ///< one line
    std::optional<double> fallback = {};  ///< default [unit]
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();  ///< both ends are allowed
};

/// Results of a measure, for files and for people. Names are below /characterization, such as "pore_size/mean".
class MeasureResult {
public:
    /// @param standard_error of the value over structures of the same kind, as block_errors estimates it; stored under
    /// "uncertainty/" + name if it is finite.
    void add(const std::string& name, double value, const std::string& unit, const std::string& description,
             double standard_error = unset);
    void add_count(const std::string& name, Index value, const std::string& description);
    void add_text(const std::string& name, const std::string& value, const std::string& description);
    void add_vector(const std::string& name, const Eigen::VectorXd& values, const std::string& unit,
                    const std::string& description);
    void add_counts(const std::string& name, const Eigen::VectorXi& values, const std::string& description);
    /// A matrix as it stands, [rows][cols].
    void add_matrix(const std::string& name, const Eigen::MatrixXd& values, const std::string& unit,
                    const std::string& description);
    /// One value (or vector) per particle (d x N), which goes into the file and is seen in ParaView, not in the JSON object.
    void add_field(const std::string& name, const Eigen::MatrixXd& values, const std::string& unit, const std::string& description);
    /// A line of the table for people.
    void add_line(const std::string& label, const std::string& text);
    void append(const MeasureResult& other);
    /// Says why a measure has no results: a line, and a text under "left_out/" + its name.
    void leave_out(const std::string& measure, const std::string& reason);
    /// Why a measure has no results; empty if it has some.
    std::string reason_left_out(const std::string& measure) const;

    /// A scalar by its name, and its standard error; NaN if there is none.
    double value(const std::string& name) const;
    double standard_error(const std::string& name) const { return value("uncertainty/" + name); }

    std::vector<Dataset> datasets;
    std::vector<Dataset> contact_results;  ///< one value per contact each: for the file only
    std::vector<ParticleField> fields;
    Table lines;
};

/// One line of the table of measures.
struct Measure {
    std::string name;     ///< as --only names it; its results are below /characterization/NAME
    std::string summary;  ///< one line: what is measured
    MeasureResult (*run)(const MeasureInput& input);
    std::vector<MeasureOption> options = {};  ///< that it reads
    bool by_default = true;                   ///< whether it is measured when nothing is asked for by name
    std::vector<std::string> along = {};      ///< measures whose results it needs beside its own, reported with it
    std::string when_given = {};              ///< option that asks for the measure when a value is given
};

/// All measures, in the order in which they are reported.
const std::vector<Measure>& measures();

/// The names of all measures.
std::vector<std::string> measure_names();

/// The options of all measures, each once.
std::vector<MeasureOption> measure_options();

/// Throws std::invalid_argument where none of the measures that run_measures(input, only) runs reads one of the options that are
/// given.
void check_options(const std::vector<std::string>& given, const std::vector<std::string>& only);

/// Runs the measures named in `only` ("all": every one; empty: those of the default), those asked for by an option, and those that
/// go along. A few facts about the packing itself come first. A measure that fails, or finds what is no number, is left out with a
/// sentence and takes no other with it. Throws std::invalid_argument for an unknown name or bad packing, NotApplicable when a
/// measure asked for by name does not apply, std::runtime_error when every measure was left out and one of them failed.
MeasureResult run_measures(const MeasureInput& input, const std::vector<std::string>& only = {},
                           const std::vector<Measure>& table = measures());

}  // namespace coagula::characterize
