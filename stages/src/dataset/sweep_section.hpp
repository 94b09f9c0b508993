// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of a sweep file, and the combinations of the values in them.
#pragma once

#include "axis.hpp"
#include "design.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace coagula::stages {

constexpr std::size_t most_structures = 200000;

/// The options of one stage.
struct Section {
    Verb verb;
    std::string where;  ///< "FILE, [shear]"
    std::vector<Axis> axes;
    std::int64_t replicates = 1;
};

/// Throws InputError "WHERE, key 'KEY': rule".
[[noreturn]] void fail_at(const std::string& where, const std::string& key, const std::string& rule);

using Values = std::map<std::string, Given>;

/// The sections of one structure in the order of the stages, and the values that the design gives them.
class Combinations {
public:
    Combinations(const Section& generate, const std::optional<Section>& characterize, const std::optional<Section>& shear);

    /// Number of structures. Throws InputError where a set holds fewer.
    std::size_t count(const Design& design) const;

    /// Calls `take` with the values of each structure. Structures that share a generated one come one after the other in a grid.
    void each(const Design& design, const std::function<void(const std::array<Values, 3>&)>& take) const;

private:
    std::size_t product(std::size_t points, std::size_t factor) const;
    std::array<Values, 3> values_at(const std::function<Given(const Axis&, std::size_t)>& choose) const;
    bool advance(std::vector<std::size_t>& place) const;
    void replicate(std::array<Values, 3> values, const std::function<void(const std::array<Values, 3>&)>& take) const;

    std::array<const Section*, 3> sections_;
    std::vector<std::pair<std::size_t, std::size_t>> varied_;  ///< stage and number of each axis with several values
};

}  // namespace coagula::stages
