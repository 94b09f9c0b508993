// SPDX-License-Identifier: GPL-3.0-or-later
// What the headings and units of measured tables mean.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace coagula::io {

/// A heading and its place in the list of known headings: of two columns with one meaning, the one that stands first there is meant
/// ("Oscillation torque" before "Torque"). A word may stand beside its symbol, "Storage modulus (G')".
struct KnownHeading {
    std::string quantity;  ///< empty: not known
    std::size_t rank = std::numeric_limits<std::size_t>::max();
};
KnownHeading known_heading(std::string_view heading);

/// A unit as UDUNITS reads it: "[µNm]" is "µN.m", "Pas" is "Pa.s", "mrad/N.m" is "mrad/(N.m)", "-" is "1".
std::string normal_unit(std::string_view text);

struct HeadingWithUnit {
    std::string heading;
    std::string unit;  ///< normal; empty when there is none
};
/// Heading and unit of "strain [%]". Where what is left is a known heading and what is right a unit, also of "strain (%)",
/// "strain / %", "strain in %", "strain en %", "strain, %", "strain_%" and "strain %".
HeadingWithUnit split_heading(std::string_view text);

}  // namespace coagula::io
