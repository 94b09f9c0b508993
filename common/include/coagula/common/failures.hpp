// SPDX-License-Identifier: GPL-3.0-or-later
// Ways in which work fails that a caller tells apart, and the sentence about an exception that nobody expected.
#pragma once

#include <coagula/common/checks.hpp>

#include <exception>
#include <string>

namespace coagula {

/// The output exists already, and nobody said that it may be replaced: exit code 3.
struct ExistsAlready : InputError {
    using InputError::InputError;
};

/// No structure has what was asked for, such as a coordination number at this volume fraction: exit code 4.
struct OutOfReach : InputError {
    using InputError::InputError;
};

/// One sentence on one line about an exception. An std::runtime_error that is nothing more specific has its sentence already; a
/// lack of memory is called so; what a library throws (Boost.Math, CGAL, a JSON parser) is quoted as the reason.
std::string failure_sentence(const std::exception& error);

/// A terminate handler: prints the sentence of the exception that nobody could catch, such as one in a parallel region, and ends
/// the program with exit code 1.
[[noreturn]] void end_with_sentence();

}  // namespace coagula
