// SPDX-License-Identifier: GPL-3.0-or-later
// Input of the measures: the packing, the values of the options, and what several measures share, computed once.
#pragma once

#include <coagula/characterize/blocks.hpp>
#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/characterize/voronoi_cells.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace coagula::characterize {

struct ReducedDiagram;

class MeasureInput {
public:
    /// @param options values by name, in the unit of the option (SI); those not given have the default of the table of measures.
    explicit MeasureInput(Packing packing, std::map<std::string, double> options = {}, std::uint64_t seed = 1,
                          Progress progress = {});
    MeasureInput(MeasureInput&& other) noexcept;
    MeasureInput& operator=(MeasureInput&& other) noexcept;
    MeasureInput(const MeasureInput&) = delete;
    MeasureInput& operator=(const MeasureInput&) = delete;
    ~MeasureInput();

    const Packing& packing() const { return packing_; }
    /// The mean radius r0 [m].
    double r0() const { return r0_; }
    std::uint64_t seed() const { return seed_; }
    const Progress& progress() const { return progress_; }

    /// Whether an option has a value, given or default.
    bool has(const std::string& option) const;
    /// Whether a value was given.
    bool given(const std::string& option) const { return options_.contains(option); }
    /// The value of an option. Throws std::invalid_argument if it has none.
    double number(const std::string& option) const;
    Index count(const std::string& option) const;

    // Shared, each computed when it is first asked for. Not to be called from several threads at once.

    /// Inner particles (inner_particles.hpp), N flags.
    const std::vector<bool>& inner() const;
    /// Sub-volumes of the inner particles, for standard errors.
    const Blocks& blocks() const;
    /// Contacts within the option contact-tolerance, and coordination numbers.
    const Coordination& coordination() const;
    const ContactNetwork& contacts() const { return coordination().contacts; }
    /// Volumes of the Voronoi (power) cells.
    const VoronoiCells& voronoi_cells() const;
    /// Neighbours in the Voronoi (power) diagram and the areas of the faces between.
    const VoronoiFaces& voronoi_faces() const;
    /// The diagram itself (internal, reduced_diagram.hpp).
    const ReducedDiagram& diagram() const;
    /// The exact pore-size curve at as many radii as the option radii says.
    const PoreSizes& pores() const;
    /// Whether somebody asked for the pores already.
    bool has_pores() const;

private:
    struct Shared;

    Packing packing_;
    double r0_;
    std::map<std::string, double> options_;
    std::uint64_t seed_;
    Progress progress_;
    std::unique_ptr<Shared> shared_;
};

}  // namespace coagula::characterize
