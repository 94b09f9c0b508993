// SPDX-License-Identifier: GPL-3.0-or-later
// coagula report: one page with a view of the structures and all results of their files.
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/stages/files.hpp>

namespace coagula::tools {

void run_report(const Arguments& arguments) {
    const Printed printed = stages::report_files(arguments);
    report(arguments, printed.json, printed.table);
}

}  // namespace coagula::tools
