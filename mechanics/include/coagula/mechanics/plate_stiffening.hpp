// SPDX-License-Identifier: GPL-3.0-or-later
// How much the plates of a rheometer stiffen the sample between them.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <vector>

namespace coagula::mechanics {

/// Shear moduli of one orientation at vanishing strain, of the same springs.
struct PlateStiffening {
    ShearOrientation orientation;
    double between_plates = unset;  ///< G' between rough rigid plates [Pa]
    double periodic = unset;        ///< G' of the periodic cell [Pa]

    /// NaN where the periodic cell bears no shear.
    double ratio() const { return periodic > 0 ? between_plates / periodic : unset; }
};

/// Solves for the linear response of `bonds` between plates as run_rheometer() mounts them: layers of the periodic repetition,
/// whose particles neither turn nor move, but the upper plate as a whole. The modulus is twice the energy over volume and strain
/// squared.
///
/// @param periodic solve_linear() of the same packing and bonds, whose springs and moduli are taken.
/// @param plate_layers thickness of a plate in mean diameters.
/// @param options solver, its limits and tolerances.
/// Throws std::invalid_argument for an open cell or a response of other bonds, std::runtime_error when the solver fails.
std::vector<PlateStiffening> plate_stiffening(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& periodic,
                                              const std::vector<ShearOrientation>& orientations, double plate_layers = 3,
                                              const LinearOptions& options = {}, const Progress& progress = {});

}  // namespace coagula::mechanics
