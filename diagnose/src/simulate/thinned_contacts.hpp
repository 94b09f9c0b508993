// Networks of which contacts are missing at random.
#pragma once

#include <coagula/common/contact_network.hpp>

#include <cstdint>

namespace coagula::diagnose {

/// The network without this share of its contacts, those that come first in a random order: what misses fewer holds all that misses
/// more.
/// @param share 0 .. 1. @param order number of the random order.
ContactNetwork thinned(const ContactNetwork& contacts, double share, std::uint64_t order);

}  // namespace coagula::diagnose
