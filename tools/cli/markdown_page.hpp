// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of the verbs in Markdown, from the tables of options: the reference of the manual.
#pragma once

#include "stages.hpp"

#include <string>
#include <vector>

namespace coagula::tools {

/// The verbs with their summaries, each with a link to its page, `page_name(verb)` with the ending .md in the same folder.
std::string program_markdown(const std::vector<Verb>& verbs);

/// Synopsis, notes and a table of the options of one verb.
std::string verb_markdown(const Verb& verb);

}  // namespace coagula::tools
