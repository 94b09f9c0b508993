// The verbs of the program, one file each.
#pragma once

#include "arguments.hpp"

#include <vector>

namespace coagula::tools {

Verb generate_brownian_verb();
Verb generate_vem_verb();
Verb characterize_verb();
Verb shear_verb();
Verb diagnose_verb();
Verb info_verb();
Verb import_verb();
Verb export_verb();
Verb report_verb();
Verb calibrate_verb();
Verb fit_power_law_verb();
Verb plot_verb();
Verb completion_verb();
Verb man_verb();

/// All verbs, in the order in which help texts list them.
std::vector<Verb> all_verbs();

}  // namespace coagula::tools
