// coagula diagnose --new: an experiment file from the exports of instruments.
#pragma once

#include "cli/arguments.hpp"

namespace coagula::tools {

void run_new(const Arguments& arguments);

}  // namespace coagula::tools
