// SPDX-License-Identifier: GPL-3.0-or-later
// Particles as an image shows them, for what is measured of all centres together.
#pragma once

#include <coagula/common/packing.hpp>

#include <cstdint>

namespace coagula::diagnose {

struct ImageErrors {
    double plane;   ///< standard deviation of a centre in the plane x-y [m]
    double axis;    ///< the same along z [m]
    double missed;  ///< share of the particles
    double wrong;   ///< share of the centres that are no particle
};

/// The particles of a periodic structure that an image shows, with independent normal errors from a fixed seed, and false centres
/// of the mean radius at random places not nearer than half a diameter to another centre. With more errors, of the same draw, the
/// same particles are missed and some more.
Packing as_imaged(const Packing& packing, const ImageErrors& errors, std::uint64_t draw);

}  // namespace coagula::diagnose
