// SPDX-License-Identifier: GPL-3.0-or-later
// Mounts a packing in the rheometer: between two plates, which are slices of its periodic images, or on its own in a periodic cell.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <vector>

namespace coagula::mechanics {

/// The packing that is sheared: the sample and its plates, if there are any.
struct MountedSample {
    Packing packing;                 ///< the sample first, then the plates; periodic, with room between the plates' backs
    ContactNetwork bonds;            ///< those inside the plates left out
    std::vector<Index> origin;       ///< particle of the sample that each particle is or repeats
    std::vector<Index> bond_origin;  ///< bond of the sample that each bond is or repeats
    std::vector<Index> lower;        ///< particles of the fixed plate; empty without plates
    std::vector<Index> upper;        ///< of the driven plate
    double bottom = 0;               ///< the sample reaches from here ...
    double height = 0;               ///< ... so far along the normal [m]
    double area = 0;                 ///< of a plate [m^2]

    double volume() const { return area * height; }
    bool has_plates() const { return !lower.empty(); }
};

/// Mounts `packing`; with plates, every bond is repeated wherever it joins two particles that are there.
MountedSample mount(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options,
                    const ShearOrientation& orientation);

}  // namespace coagula::mechanics
