#include "cli/verbs.hpp"

namespace coagula::tools {

std::vector<Verb> all_verbs() {
    return {generate_vem_verb(), generate_brownian_verb(),
            characterize_verb(), shear_verb(),
            calibrate_verb(),    fit_power_law_verb(),
            diagnose_verb(),     info_verb(),
            import_verb(),       export_verb(),
            report_verb(),       plot_verb(),
            completion_verb(),   man_verb()};
}

}  // namespace coagula::tools
