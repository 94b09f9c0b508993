// SPDX-License-Identifier: GPL-3.0-or-later
// Two structures held against each other by the three measures of heterogeneity.
#pragma once

#include <coagula/characterize/density_fluctuations.hpp>
#include <coagula/characterize/measure.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace coagula::characterize {

/// A measure of heterogeneity of two structures; the larger value is that of the more heterogeneous one.
struct ComparedMeasure {
    std::string name;     ///< as in the JSON object, "pore_sizes"
    std::string meaning;  ///< one line
    std::array<double, 2> value = {unset, unset};
    std::array<double, 2> error = {unset, unset};  ///< standard errors over structures of the same kind; NaN if not known

    double difference() const { return value[1] - value[0]; }
    double difference_error() const;
    /// Which structure (0 or 1) is more heterogeneous; nothing if they differ by less than two standard errors or an error is not
    /// known.
    std::optional<std::size_t> more_heterogeneous() const;
};

/// Joint result of the measures.
enum class Agreement {
    all,       ///< every measure names the same structure
    some,      ///< some name the same structure, the others do not tell
    none,      ///< no measure tells the structures apart
    disagree,  ///< one measure names one structure, another the other
};

/// After Schenker et al., Phys. Rev. E 80 (2009) 021302: the width a of the pore-size curve, the width of the distribution of the
/// Voronoi volumes and the integral of the density fluctuations over the size of the windows.
struct HeterogeneityComparison {
    std::vector<ComparedMeasure> measures;  ///< the three; fewer if one does not apply to both structures
    std::vector<std::string> left_out;      ///< a sentence for each of the others
    ComparedMeasure main_part;        ///< a fitted to P >= 0.1 only: not a fourth measure, a check of the first; NaN if unknown
    LargestDifference fluctuations;   ///< where the density fluctuations differ most; lengths over r0; NaN if left out
    std::vector<std::string> unfair;  ///< a sentence for each reason why the comparison is not fair; empty if it is

    Agreement agreement() const;
    /// The structure that the measures name, unless they disagree or none tells.
    std::optional<std::size_t> more_heterogeneous() const;
};

/// All lengths are taken in units of each structure's mean radius, so that these may differ. A comparison is not fair where the
/// structures differ in volume fraction by more than 1 %, in the relative spread of their radii by more than 0.01, or in the number
/// of particles by more than a factor of 2, and where only one of them has a free surface.
/// @param names of the structures, for the sentence of std::invalid_argument if pores or Voronoi cells cannot be measured.
HeterogeneityComparison compare_heterogeneity(const MeasureInput& first, const MeasureInput& second,
                                              const std::array<std::string, 2>& names = {"the first structure",
                                                                                         "the second structure"});

}  // namespace coagula::characterize
