// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of particles that act on each other at a frequency: bonds, and neighbours that squeeze a film of solvent.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/general_contact.hpp>
#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::mechanics {

/// Bonds and pairs that squeeze a film of solvent.
struct FrequencyPairs {
    ContactNetwork network;                ///< bonds first
    Index bonds = 0;                       ///< how many
    std::vector<ContactTangent> tangents;  ///< springs of every pair [N/m]; those without a bond have none
    std::vector<double> film;              ///< of every pair: drag of the film over the viscosity [m]; 0: none
    std::vector<bool> rough;               ///< whether the film is as thin as it can be, lubrication_gap
};

/// Pairs with a gap h between their surfaces below lubrication_cutoff have a film: force over viscosity and relative velocity along
/// the line of centres 6 pi R^2 / max(h, lubrication_gap), R = r_i r_j / (r_i + r_j) (Jeffrey and Onishi 1984, leading term). Films
/// need a solvent; without it there are none.
FrequencyPairs find_frequency_pairs(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model);

}  // namespace coagula::mechanics
