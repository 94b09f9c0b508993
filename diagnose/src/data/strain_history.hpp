// SPDX-License-Identifier: GPL-3.0-or-later
// Shear history of each sample: how fast and when.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <map>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A stretch of time on the clock of a sample (run_clock.hpp).
struct ShearedSpan {
    double from = 0;         ///< [s]
    double to = 0;           ///< [s]
    double rate = 0;         ///< mean magnitude of the shear rate [1/s]; of an oscillation 2 / pi times its amplitude
    bool destroyed = false;  ///< a shear right before it has destroyed the structure
};

/// Spans in which samples were sheared, in the order of time; between them they rest. A row lasts from the one before it to its own
/// time, the first of a run as long as the others in the mean.
class StrainHistory {
public:
    explicit StrainHistory(const Experiment& experiment);

    /// History of the sample of a table; none where the order of its runs is unknown.
    const std::vector<ShearedSpan>& of(std::size_t table) const { return samples_.at(names_.at(table)); }

private:
    std::vector<std::string> names_;  ///< of the sample of each table
    std::map<std::string, std::vector<ShearedSpan>> samples_;
};

}  // namespace coagula::diagnose
