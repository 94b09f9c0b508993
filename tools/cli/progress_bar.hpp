// A progress bar on the terminal, and the way an interruption reaches the work.
#pragma once

#include <coagula/common/progress.hpp>

namespace coagula::tools {

/// Draws a bar on standard error when that is a terminal and `quiet` is false; in any case cancels the work once the user has
/// interrupted it.
Progress make_progress(bool quiet);

}  // namespace coagula::tools
