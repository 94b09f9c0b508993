// SPDX-License-Identifier: GPL-3.0-or-later
// Measuring packings.
#pragma once

#include <coagula/characterize/measure.hpp>
#include <coagula/characterize/position_noise.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/stages/arguments.hpp>
#include <coagula/stages/bond_potential.hpp>
#include <coagula/stages/findings.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coagula::stages {

struct CharacterizeRun {
    std::vector<std::string> only = {};          ///< names of measures; empty: those of a default run
    std::map<std::string, double> options = {};  ///< of measures, those that are given
    std::uint64_t seed = 1;
    std::optional<characterize::PositionNoise> noise = {};
};

Verb characterize_verb();
/// @param bonds of the structure, where they are known: their tolerance is that of contacts where none is given.
CharacterizeRun characterize_run(const Arguments& arguments, const std::optional<BondPotential>& bonds = std::nullopt);
Findings measure(const CharacterizeRun& run, const Packing& packing, const Progress& progress);

/// The options of a comparison, for which only those of the measures of heterogeneity and the seed count.
CharacterizeRun comparison_run(const Arguments& arguments);
/// Which of two packings is more heterogeneous. @param names of the packings in the answer.
Printed compare(const CharacterizeRun& run, const std::array<std::string, 2>& names, const std::array<Packing, 2>& packings,
                const Progress& progress);

}  // namespace coagula::stages
