// Packings as the verbs `generate vem` and `generate brownian` make them, for those that need one in memory.
#pragma once

#include "cli/arguments.hpp"

#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

namespace coagula::tools {

/// @param arguments of `generate vem`; its output is not written.
Packing expanded_packing(const Arguments& arguments, const Progress& progress);

/// @param arguments of `generate brownian` with --stop-coordination; its output is not written. Throws InputError when the
/// suspension does not coagulate so far within some diffusion times.
Packing coagulated_packing(const Arguments& arguments, const Progress& progress);

}  // namespace coagula::tools
