// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures by the program gnuplot.
#pragma once

#include <string>

namespace coagula::report {

struct GnuplotOutput {
    std::string picture;
    std::string problem;  ///< why there is no picture, one clause; empty while there is one
};

/// What gnuplot writes for these commands. All goes through memory: no file is named in the commands, so that no name is read as
/// one.
/// @param commands beginning with those that set the terminal.
GnuplotOutput run_gnuplot(const std::string& commands);

/// The SVG without gnuplot's names of curves, which a browser would show under the mouse.
std::string without_names(std::string svg);

}  // namespace coagula::report
