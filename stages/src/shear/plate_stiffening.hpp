// SPDX-License-Identifier: GPL-3.0-or-later
// Effect of the plates of the rheometer on its moduli.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/mechanics/linear.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include <optional>

namespace coagula::stages {

/// Adds by how much the plates stiffen this structure, by the linear method with and without them, and the modulus of `result` over
/// that ratio. NaN where there is no linear response.
void append_plate_stiffening(Findings& found, const Packing& packing, const ContactNetwork& bonds,
                             const std::optional<mechanics::LinearResponse>& linear, const mechanics::RheometerResult& result,
                             double plate_layers, const Progress& progress);

}  // namespace coagula::stages
