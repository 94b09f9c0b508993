// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C: the first one asks the work to stop at the next progress report and ends the program where that does not come within a
// second; the second one ends the program at once.
#pragma once

namespace coagula::tools {

/// Installs the handlers of SIGINT and SIGTERM, lets a file-size limit be an error of the write instead of a death, and waits for
/// child processes also where the caller ignores SIGCHLD.
void install_signal_handlers();

/// Whether the user has asked to stop. Who gets this answer ends the work: the program is then not ended by force.
bool interrupted();

}  // namespace coagula::tools
