// SPDX-License-Identifier: GPL-3.0-or-later
// Contact networks from which contacts are removed at random, and their moduli.
#pragma once

#include <coagula/common/contact_network.hpp>
#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <cstddef>
#include <cstdint>

namespace coagula::diagnose {

/// Removes this share of the contacts, those that come first in a random order. A network with a smaller share removed contains
/// every network with a larger one.
/// @param share share of the contacts to remove, 0 .. 1. @param order number of the random order.
ContactNetwork thinned(const ContactNetwork& contacts, double share, std::uint64_t order);

/// G without a share of the contacts, missing at random, over G with all of them, at vanishing strain: between nodes, for the
/// contacts of the base model. A thousandth at least, where nothing bears a load.
double thinned_response(Simulator& simulator, double missing, std::size_t group = 0);
/// The same by runs with the contacts of the settings.
double exact_thinned_response(Simulator& simulator, const Settings& settings, double missing, std::size_t group = 0);

}  // namespace coagula::diagnose
