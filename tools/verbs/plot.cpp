// SPDX-License-Identifier: GPL-3.0-or-later
// coagula plot: a figure of one or more result files, or the figures of the paper.
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/stages/files.hpp>

namespace coagula::tools {

void run_plot(const Arguments& arguments) {
    const Printed printed = stages::plot_files(arguments);
    report(arguments, printed.json, printed.table);
}

}  // namespace coagula::tools
