// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of arguments: a failed one throws std::invalid_argument with a sentence that names the object, the value and the rule.
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace coagula {

/// A physical parameter that nobody has given yet.
inline constexpr double unset = std::numeric_limits<double>::quiet_NaN();

/// A value as it is printed in messages: the shortest text that reads back as the same number.
std::string to_text(double value);

/// "a, b, c".
std::string list_of(const std::vector<std::string>& names);

/// Throws std::invalid_argument(sentence) unless `condition` holds.
void require(bool condition, std::string_view sentence);

/// Returns `value` if it is finite and > 0; otherwise throws, naming `object` (such as "the particle radius") and `unit`.
double require_positive(double value, std::string_view object, std::string_view unit = "");

/// Returns `value` if it is finite and >= 0; otherwise throws.
double require_non_negative(double value, std::string_view object, std::string_view unit = "");

/// Returns `value` if low < value < high; otherwise throws.
double require_between(double value, double low, double high, std::string_view object, std::string_view unit = "");

/// Bad input that the user can mend: the program ends with exit code 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace coagula
