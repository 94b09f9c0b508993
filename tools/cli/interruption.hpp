// Ctrl-C: the first one asks the work to stop at the next progress report, the second one ends the program at once.
#pragma once

namespace coagula::tools {

/// Installs the handlers of SIGINT and SIGTERM, and lets a file-size limit be an error of the write instead of a death.
void install_signal_handlers();

/// Whether the user has asked to stop.
bool interrupted();

}  // namespace coagula::tools
