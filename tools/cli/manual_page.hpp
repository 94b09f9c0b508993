// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages in the language of man(7), from the tables of options.
#pragma once

#include "stages.hpp"

#include <string>
#include <vector>

namespace coagula::tools {

/// "coagula-generate-vem", the name of a verb's page.
std::string page_name(const Verb& verb);

/// coagula(1): the verbs, and what holds for all of them.
std::string program_page(const std::vector<Verb>& verbs, const std::string& version);

/// The page of one verb, coagula-VERB(1).
std::string verb_page(const Verb& verb, const std::string& version);

}  // namespace coagula::tools
