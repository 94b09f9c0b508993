// SPDX-License-Identifier: GPL-3.0-or-later
// A progress bar on the terminal, and the way an interruption reaches the work.
#pragma once

#include <coagula/common/progress.hpp>

#include <string>

namespace coagula::tools {

/// Draws a bar on standard error when that is a terminal, and says there how long a long run will take, unless `quiet`; in any case
/// cancels the work once the user has interrupted it.
/// @param faster how the user can have it faster, such as "--orientation xy takes a sixth of it"; empty: nobody knows.
Progress make_progress(bool quiet, std::string faster = {});

}  // namespace coagula::tools
