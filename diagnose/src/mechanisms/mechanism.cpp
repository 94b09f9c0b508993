// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/mechanism.hpp>

#include "data/knows.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>

#include <algorithm>
#include <array>
#include <cmath>

// NOLINTBEGIN(cppcoreguidelines-macro-usage): no template makes declarations and calls of one list of names

// One line per mechanism, whose file in mechanisms/ defines a function of this name.
#define COAGULA_CATALOGUE(ENTRY)    \
    ENTRY(shear_stiffness)          \
    ENTRY(bond_bending)             \
    ENTRY(bond_range)               \
    ENTRY(missing_contacts)         \
    ENTRY(bond_strength)            \
    ENTRY(activated_rupture)        \
    ENTRY(plate_strain_field)       \
    ENTRY(contact_nonlinearity)     \
    ENTRY(bond_stiffening)          \
    ENTRY(reversible_softening)     \
    ENTRY(thixotropy)               \
    ENTRY(prestress)                \
    ENTRY(contact_loss)             \
    ENTRY(contact_dashpot)          \
    ENTRY(contact_relaxation)       \
    ENTRY(solvent_drag)             \
    ENTRY(ageing)                   \
    ENTRY(ageing_after_shear)       \
    ENTRY(ageing_power)             \
    ENTRY(ageing_saturating)        \
    ENTRY(temperature_drift)        \
    ENTRY(loading_relaxation)       \
    ENTRY(shear_thinning)           \
    ENTRY(evaporation)              \
    ENTRY(sedimentation)            \
    ENTRY(poroelastic_backflow)     \
    ENTRY(normal_load)              \
    ENTRY(sample_inertia)           \
    ENTRY(gap_error)                \
    ENTRY(wall_slip)                \
    ENTRY(volume_fraction_gradient) \
    ENTRY(radius_error)             \
    ENTRY(edge_fracture)            \
    ENTRY(sudden_loss)              \
    ENTRY(drying_rim)               \
    ENTRY(tool_compliance)          \
    ENTRY(tool_inertia)             \
    ENTRY(bearing_damping)          \
    ENTRY(phase_offset)             \
    ENTRY(torque_offset)            \
    ENTRY(numerical)                \
    ENTRY(localisation_error)       \
    ENTRY(polydispersity)           \
    ENTRY(surface_potential)        \
    ENTRY(ionic_strength)           \
    ENTRY(volume_fraction)          \
    ENTRY(coordination)             \
    ENTRY(heterogeneity)

namespace coagula::diagnose {

namespace mechanisms {

#define COAGULA_DECLARED(name) Mechanism name();
COAGULA_CATALOGUE(COAGULA_DECLARED)
#undef COAGULA_DECLARED

}  // namespace mechanisms

const char* name_of(Link link) {
    constexpr std::array names{"structure", "material", "history", "geometry", "tool", "errors"};
    return names.at(static_cast<std::size_t>(link));
}

const char* name_of(Axis axis) {
    constexpr std::array names{"time",          "age",      "strain",       "frequency",       "shear_rate",
                               "gap",           "radius",   "normal_force", "volume_fraction", "coordination",
                               "heterogeneity", "distance", "pore_radius",  "sample",          "level"};
    return names.at(static_cast<std::size_t>(axis));
}

double MechanismParameter::at(double place) const {
    if (small > 0) {
        return small * std::sinh(std::lerp(std::asinh(low / small), std::asinh(high / small), place));
    }
    return logarithmic ? low * std::pow(high / low, place) : low + (high - low) * place;
}

double MechanismParameter::place_of(double given) const {
    if (small > 0) {
        const double first = std::asinh(low / small);
        return (std::asinh(given / small) - first) / (std::asinh(high / small) - first);
    }
    return logarithmic ? std::log(given / low) / std::log(high / low) : (given - low) / (high - low);
}

double MechanismParameter::rounded(double place) const {
    return step > 0 ? std::round(place / step) * step : place;
}

std::span<const Mechanism> catalogue() {
#define COAGULA_MADE(name) mechanisms::name(),
    static const std::vector<Mechanism> all{COAGULA_CATALOGUE(COAGULA_MADE)};
#undef COAGULA_MADE
    return all;
}

// NOLINTEND(cppcoreguidelines-macro-usage)

bool can_act(const Mechanism& mechanism, const Experiment& experiment) {
    const bool of_instrument =
        std::holds_alternative<ChangesGeometry>(mechanism.effect) || std::holds_alternative<ChangesTool>(mechanism.effect);
    const MaterialKind kind = experiment.material.kind;
    const bool can = of_instrument || kind == MaterialKind::network || (kind == MaterialKind::newtonian && mechanism.in_any_fluid);
    return can && mechanism.applies(knowledge_of(experiment));
}

const Mechanism* find_mechanism(const std::string& name) {
    const auto all = catalogue();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Mechanism& entry) { return entry.name == name; });
    return found == all.end() ? nullptr : &*found;
}

void require_causes(const std::vector<std::string>& names) {
    std::vector<std::string> known;
    for (const Mechanism& entry : catalogue()) {
        known.push_back(entry.name);
    }
    for (const std::string& name : names) {
        if (find_mechanism(name) == nullptr) {
            throw InputError("'" + name + "' is not a cause of the catalogue" + did_you_mean(name, known));
        }
    }
}

bool is_asked_for(const Mechanism& mechanism, const std::vector<std::string>& names) {
    return names.empty() || std::find(names.begin(), names.end(), mechanism.name) != names.end();
}

}  // namespace coagula::diagnose
