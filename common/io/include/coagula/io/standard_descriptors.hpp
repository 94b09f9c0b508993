// SPDX-License-Identifier: GPL-3.0-or-later
// Standard input, output and error, which whoever starts a program may have closed.
#pragma once

namespace coagula::io {

/// Opens /dev/null as those of the descriptors 0, 1 and 2 that are closed. Otherwise the next file gets the number, and what is
/// meant for standard error goes into it. Writing to the standard output made so fails, as it would to a closed one.
void occupy_standard_descriptors();

}  // namespace coagula::io
