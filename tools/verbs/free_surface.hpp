// How a sample with a free surface is strained.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/mechanics/linear.hpp>

namespace coagula::tools {

/// Held are the outer particles, those whose Voronoi cells the surroundings could change; the stress is averaged over the cells of
/// the others.
void hold_surface(const Packing& packing, mechanics::LinearOptions& options);

}  // namespace coagula::tools
