// The power diagram of a packing with the cells to be measured counted. Internal.
#pragma once

#include "power_diagram.hpp"

#include <coagula/common/packing.hpp>

namespace coagula::characterize {

/// All cells of a periodic packing; the inner ones of an open one (inner_particles.hpp), and only the edges they have.
/// Throws std::invalid_argument if there are none.
PowerDiagram counted_diagram(const Packing& packing);

/// The same cells, for spheres whose radii have grown by `growth`.
PowerDiagram grown_diagram(const Packing& packing, const PowerDiagram& original, double growth);

}  // namespace coagula::characterize
