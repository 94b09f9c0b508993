// SPDX-License-Identifier: GPL-3.0-or-later
// coagula export: coordinates (and bonds) for other programs.
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/stages/files.hpp>

namespace coagula::tools {

void run_export(const Arguments& arguments) {
    const Printed printed = stages::export_file(arguments);
    report(arguments, printed.json, printed.table);
}

}  // namespace coagula::tools
