// SPDX-License-Identifier: GPL-3.0-or-later
// The structures behind a simulation: as they were given, or made again with something changed.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/diagnose/settings.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Settings with the structures as they are.
Settings as_stated(Settings settings);

/// Probability that a point of the void space is farther than r from the nearest particle surface, at equally spaced r.
struct PoreCurve {
    double largest = 0;               ///< pore radius [m]
    std::vector<double> probability;  ///< from r = 0 to `largest`

    /// Linear between the radii; 0 beyond the largest.
    double at(double radius) const;
};

/// Stages before a simulation, which this library does not include.
struct OtherStages {
    /// Makes a structure, by its number, by the recipe with this change. Empty where the structures are no recipe's.
    std::function<Packing(std::size_t structure, const StructureChange& change)> make = {};
    /// All that decides what `make` returns, in one line: part of the name of what is simulated with it.
    std::function<std::string(std::size_t structure, const StructureChange& change)> name = {};
    /// The pore curve of a structure; empty: no pore curve can be predicted.
    std::function<PoreCurve(const Packing& packing)> measure_pores = {};
};

/// Structures by their numbers; what has to be made is made when it is first asked for. Not for several threads at once.
class Structures {
public:
    explicit Structures(std::vector<Packing> given);
    /// @param particles of each.
    Structures(std::vector<std::size_t> particles, std::function<Packing(std::size_t structure)> make);

    const Packing& operator[](std::size_t structure) const;
    bool is_made(std::size_t structure) const { return packings_[structure].has_value(); }
    std::size_t size() const { return particles_.size(); }
    std::size_t particles(std::size_t structure) const { return particles_[structure]; }

private:
    std::vector<std::size_t> particles_;
    std::function<Packing(std::size_t structure)> make_;
    mutable std::vector<std::optional<Packing>> packings_;
};

}  // namespace coagula::diagnose
