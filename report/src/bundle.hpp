// SPDX-License-Identifier: GPL-3.0-or-later
// The scripts and the style of the pages, made from web/ by scripts/bundle-web; empty in a program built without them.
#pragma once

#include <string_view>

namespace coagula::report {

extern const std::string_view structure_script;
extern const std::string_view diagnosis_script;
extern const std::string_view set_script;
extern const std::string_view page_style;

}  // namespace coagula::report
