// SPDX-License-Identifier: GPL-3.0-or-later
// Statements of exports about instrument and sample, and their use in an experiment.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/io/measured_file.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace coagula::experiment {

/// A value that an export gives.
struct TakenOver {
    std::string name;    ///< key of the experiment file: "plate_radius"
    double value;        ///< in `unit`; unset for a geometry
    std::string unit;    ///< SI
    std::string text;    ///< of a geometry
    std::string source;  ///< file and what stands there
    std::string fate;    ///< "taken over", or why not
};

/// Collects the values of all exports of an experiment.
class ExportMetadata {
public:
    /// @param first of the measurements that come from this file, up to `end`.
    void add(const std::string& name, const io::MeasuredFile& file, std::size_t first, std::size_t end);

    /// Fills in what the experiment file leaves open: the instrument, the temperature of the sample from columns that agree to 1 K,
    /// and, where exports differ in plate radius or gap, a constant of the tables of each. A value that contradicts another, or the
    /// experiment file, is not taken.
    std::vector<TakenOver> give_to(diagnose::Experiment& experiment) const;

private:
    struct Source {
        std::string file;
        io::InstrumentValue value;
        std::size_t first;
        std::size_t end;
    };

    void give_value(const std::string& name, diagnose::Experiment& experiment, std::vector<TakenOver>& list) const;
    void give_to_tables(const std::string& name, diagnose::Experiment& experiment, std::vector<TakenOver>& list) const;

    std::map<std::string, std::vector<Source>> sources_;  // by the name
};

}  // namespace coagula::experiment
