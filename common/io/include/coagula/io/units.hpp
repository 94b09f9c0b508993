// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities as people write them, read with UDUNITS-2: "0.25um", "15 mV", "100N/m".
#pragma once

#include <coagula/common/checks.hpp>

#include <string>
#include <vector>

namespace coagula::io {

/// The number of `unit` ("m", "V", "N/m", UDUNITS text) in a text such as "0.25um", "0.25 um" or "2.5e-7"; a bare number already
/// is in `unit`. Throws InputError with a sentence that names the text and the expected unit when there is no finite number in
/// front, the rest is not a unit or the unit has another dimension (a reciprocal, such as Hz for s, is another dimension, and so is
/// rad/s for Hz). "5ms" are milliseconds, "5 m s" and "5m.s" metre seconds. For "mol/m3" M is mol/l: "10 mM". Safe to call from
/// several threads.
double parse_quantity(const std::string& text, const std::string& unit);

/// Whether UDUNITS knows the unit, of whatever dimension.
bool is_unit_text(const std::string& text);

/// How many `to` are in one `from`: unit_factor("um", "m") is 1e-6. Throws InputError as parse_quantity does, and for a scale with
/// another zero, such as degrees Celsius.
double unit_factor(const std::string& from, const std::string& to);

/// Numbers in `from` as numbers in `to`; scales with another zero are converted too (degC to K). NaN stays NaN. Throws InputError.
std::vector<double> convert(const std::vector<double>& values, const std::string& from, const std::string& to);

}  // namespace coagula::io
