// SPDX-License-Identifier: GPL-3.0-or-later
// The observables: what a diagnosis compares with its models, with the names that results, sentences and charts give to each.
#pragma once

#include <string_view>

namespace coagula::diagnose {

/// One line of the table of observables.
struct Observable {
    std::string_view key;     ///< in results, and the name of its column: "storage_modulus"
    std::string_view phrase;  ///< in a sentence: "the viscous part of the third harmonic"
    std::string_view symbol;  ///< in the legend of a chart: "G₃″"
    std::string_view unit;    ///< UDUNITS text
    std::string_view axis;    ///< name of the coordinate along which it is drawn; empty: the axis of its table
    std::string_view whole;   ///< what the number is a share of; empty: it is no share
};

/// Null when there is none of this key. |G*| and the phase, which replicates compare in place of moduli, have one, too.
const Observable* find_observable(std::string_view key);

/// Throws std::out_of_range when there is none of this key.
const Observable& observable_named(std::string_view key);

}  // namespace coagula::diagnose
