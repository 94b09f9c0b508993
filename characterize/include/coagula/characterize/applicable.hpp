// SPDX-License-Identifier: GPL-3.0-or-later
// To which packings a measure applies.
#pragma once

#include <stdexcept>
#include <string>

namespace coagula::characterize {

/// Thrown by a measure that is not defined for the packing at hand (open, unequal spheres ...), with a sentence that says why.
/// Asked for by name this is an error; otherwise the measure is left out and the table says so.
struct NotApplicable : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};
/// Throws NotApplicable(sentence) unless the condition holds.
inline void require_applicable(bool condition, const std::string& sentence) {
    if (!condition) {
        throw NotApplicable(sentence);
    }
}

}  // namespace coagula::characterize
