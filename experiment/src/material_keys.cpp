// SPDX-License-Identifier: GPL-3.0-or-later
#include "material_keys.hpp"

#include <cmath>

namespace coagula::experiment {

diagnose::Material read_material(TomlKeys& keys) {
    constexpr double calibration = 0.01;  // of the viscosity of an oil
    const std::string kind = keys.text("kind").value_or("network");
    const auto known = diagnose::material_kind(kind);
    if (!known) {
        keys.fail("kind", "'" + kind + "' is not one of network, newtonian, smooth");
    }
    diagnose::Material material{.kind = *known};
    if (*known == diagnose::MaterialKind::newtonian) {
        material.viscosity = keys.quantity("viscosity", "Pa.s").value_or(unset);
        const double error = keys.quantity("viscosity_error", "1").value_or(calibration);
        material.viscosity_error = std::isfinite(material.viscosity) ? error : unset;
    }
    material.ages = *known == diagnose::MaterialKind::smooth && keys.flag("ages");
    keys.refuse_other_keys();
    return material;
}

}  // namespace coagula::experiment
