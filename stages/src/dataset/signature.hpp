// SPDX-License-Identifier: GPL-3.0-or-later
// Signatures tell structures of a set apart by their options.
#pragma once

#include <coagula/stages/arguments.hpp>

#include <string>

namespace coagula::stages {

struct Signature {
    std::string text;           ///< verb and options that are not the default; files count by what they hold
    std::string of_trajectory;  ///< the same without the end of a run, where other structures may lie on its trajectory
    double stop = 0;            ///< that end; 0 where there is none
};

/// Reads the files that the options name.
Signature signature_of(const Verb& verb, const Arguments& arguments);

}  // namespace coagula::stages
