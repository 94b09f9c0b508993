// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a large structure that a page shows.
#pragma once

#include <coagula/report/structure_page.hpp>

namespace coagula::report {

/// The `most` particles in the middle of the box, in a cell of the same proportions that is cut out of it and open; the whole page
/// when there are no more. With them go their values, the bonds between two of them that do not pass through the boundary of the
/// box, the values of those bonds, and the pores whose centres lie in the part. All other results stay those of the whole.
/// Throws std::invalid_argument unless `most` is positive.
PageStructure thinned(const PageStructure& page, Index most);

}  // namespace coagula::report
