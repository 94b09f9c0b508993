#include <coagula/diagnose/mechanism.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>

#include "mechanisms/mechanisms.hpp"

namespace coagula::diagnose {

double MechanismParameter::at(double place) const {
    return logarithmic ? low * std::pow(high / low, place) : low + (high - low) * place;
}

double MechanismParameter::place_of(double given) const {
    return logarithmic ? std::log(given / low) / std::log(high / low) : (given - low) / (high - low);
}

double MechanismParameter::rounded(double place) const {
    return step > 0 ? std::round(place / step) * step : place;
}

std::span<const Mechanism> catalogue() {
    // One line per mechanism.
    // clang-format off
    static const std::vector<Mechanism> all{
        mechanisms::shear_stiffness(),
        mechanisms::bond_bending(),
        mechanisms::bond_range(),
        mechanisms::bond_strength(),
        mechanisms::plate_strain_field(),
        mechanisms::contact_nonlinearity(),
        mechanisms::prestress(),
        mechanisms::contact_loss(),
        mechanisms::solvent_drag(),
        mechanisms::ageing(),
        mechanisms::ageing_after_shear(),
        mechanisms::wall_slip(),
        mechanisms::gap_error(),
        mechanisms::volume_fraction_gradient(),
        mechanisms::tool_compliance(),
        mechanisms::tool_inertia(),
        mechanisms::numerical(),
        mechanisms::localisation_error(),
        mechanisms::polydispersity(),
        mechanisms::surface_potential(),
    };
    // clang-format on
    return all;
}

const Mechanism* find_mechanism(const std::string& name) {
    const auto all = catalogue();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Mechanism& entry) { return entry.name == name; });
    return found == all.end() ? nullptr : &*found;
}

void require_causes(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (find_mechanism(name) == nullptr) {
            throw InputError("'" + name + "' is no cause of the catalogue");
        }
    }
}

bool is_asked_for(const Mechanism& mechanism, const std::vector<std::string>& names) {
    return names.empty() || std::find(names.begin(), names.end(), mechanism.name) != names.end();
}

}  // namespace coagula::diagnose
