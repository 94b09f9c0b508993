// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/observable.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace coagula::diagnose {

namespace {

constexpr std::array table{
    Observable{"storage_modulus", "G'", "G′", "Pa", "", ""},
    Observable{"loss_modulus", "G''", "G″", "Pa", "", ""},
    Observable{"complex_modulus", "|G*|", "|G*|", "Pa", "", ""},
    Observable{"phase", "the phase", "δ", "rad", "", ""},
    Observable{"third_harmonic_storage", "the elastic part of the third harmonic", "G₃′", "1", "", "the first"},
    Observable{"third_harmonic_loss", "the viscous part of the third harmonic", "G₃″", "1", "", "the first"},
    Observable{"viscosity", "the viscosity", "viscosity", "Pa.s", "", ""},
    Observable{"neighbours_plane", "the number of neighbours in the plane", "near the plane", "1", "distance", ""},
    Observable{"neighbours_axis", "the number of neighbours along z", "along z", "1", "distance", ""},
    Observable{"localisation_plane", "the scatter of a centre in the plane", "scatter of a centre in the plane, over the diameter",
               "1", "", ""},
    Observable{"localisation_axis", "the scatter of a centre along z", "along z", "1", "", ""},
    Observable{"unmatched_share", "the share of centres without a match", "share of the centres that the next image does not have",
               "1", "", ""},
    Observable{"exclusion_probability", "the share of the void space in larger pores", "pores", "1", "", "the void space"}};

}  // namespace

const Observable* find_observable(std::string_view key) {
    const auto* const found = std::find_if(table.begin(), table.end(), [&](const Observable& one) { return one.key == key; });
    return found == table.end() ? nullptr : found;
}

const Observable& observable_named(std::string_view key) {
    if (const Observable* found = find_observable(key)) {
        return *found;
    }
    throw std::out_of_range("no observable is called '" + std::string(key) + "'");
}

}  // namespace coagula::diagnose
