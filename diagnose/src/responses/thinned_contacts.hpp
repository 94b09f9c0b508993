// Contact networks from which contacts are removed at random.
#pragma once

#include <coagula/common/contact_network.hpp>

#include <cstdint>

namespace coagula::diagnose {

/// Removes this share of the contacts, those that come first in a random order. A network with a smaller share removed contains
/// every network with a larger one.
/// @param share share of the contacts to remove, 0 .. 1. @param order number of the random order.
ContactNetwork thinned(const ContactNetwork& contacts, double share, std::uint64_t order);

}  // namespace coagula::diagnose
