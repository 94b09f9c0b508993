// What `coagula characterize` finds, and the data sets it becomes.
#pragma once

#include "cli/report.hpp"

#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/common/packing.hpp>

#include <optional>

namespace coagula::tools {

/// The sampled pore-size curve held against the exact one.
struct SampledCheck {
    characterize::SampledPores sampled;
    /// (sampled - exact) / standard error, largest absolute value over the radii where the binomial distribution is close to a
    /// normal one (expected P (1 - P) n >= 25).
    double largest_z = unset;
    Index radii = 0;  ///< that were compared
};

/// Empty where it was not asked for.
struct Characterization {
    double contact_tolerance = unset;
    std::optional<characterize::Coordination> coordination = {};
    std::optional<characterize::Overlaps> overlaps = {};
    std::optional<characterize::PoreSizes> pores = {};
    std::optional<characterize::DegreeOfHeterogeneity> heterogeneity = {};
    std::optional<SampledCheck> check = {};
};

SampledCheck compare_with_samples(const Packing& packing, const characterize::PoreSizes& exact, Index points, std::uint64_t seed);

/// All of it below /characterization.
Results datasets_of(const Characterization& found, const Packing& packing);

/// Number of contacts of every particle.
std::vector<io::ParticleField> fields_of(const Characterization& found);

Table table_of(const Characterization& found, const Packing& packing);

}  // namespace coagula::tools
