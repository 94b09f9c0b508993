// SPDX-License-Identifier: GPL-3.0-or-later
#include "response.hpp"

#include "contact_losses.hpp"
#include "contact_response.hpp"
#include "drag_response.hpp"
#include "prestress_response.hpp"

#include <array>

namespace coagula::diagnose {

std::span<const Response> network_responses() {
    static const std::array all{prestressed_contacts(), hertz_contacts(), losses_in_contacts(), drag_of_solvent()};
    return all;
}

}  // namespace coagula::diagnose
