// SPDX-License-Identifier: GPL-3.0-or-later
#include "material.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr std::array<std::string_view, 3> names{"network", "newtonian", "smooth"};

void refuse(const Experiment& experiment, const std::string& what) {
    throw InputError(what + ", but material.kind is '" + std::string(name_of(experiment.material.kind)) +
                     "', which has no particles: leave one of them out");
}

}  // namespace

std::string_view name_of(MaterialKind kind) {
    return names.at(static_cast<std::size_t>(kind));
}

std::optional<MaterialKind> material_kind(std::string_view name) {
    const auto* const found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<MaterialKind>(found - names.begin()));
}

KnownScale known_scale(const Experiment& experiment) {
    const Material& material = experiment.material;
    switch (material.kind) {
        case MaterialKind::network:
            return {experiment.sample.normal_stiffness, experiment.sample.normal_stiffness_error};
        case MaterialKind::newtonian:
            return {material.viscosity, material.viscosity_error};
        default:
            return {};
    }
}

void derive_viscosity(Measurement& table) {
    const Column* rate = find_column(table, "shear_rate");
    const Column* stress = find_column(table, "stress");
    if (!is_flow(table.kind) || rate == nullptr || stress == nullptr || find_column(table, "viscosity") != nullptr) {
        return;
    }
    Column viscosity{"viscosity", "Pa.s", {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        viscosity.values.push_back(rate->values[row] == 0 ? unset : stress->values[row] / rate->values[row]);
    }
    table.columns.push_back(std::move(viscosity));
}

void check_material(const Experiment& experiment) {
    if (experiment.material.viscosity <= 0) {
        throw InputError("material.viscosity is " + to_text(experiment.material.viscosity) + " Pa.s, but must be > 0");
    }
    if (const double error = experiment.material.viscosity_error; error <= 0 || error >= 1) {
        throw InputError("material.viscosity_error is " + to_text(error) + ", but must lie between 0 and 1");
    }
    if (experiment.material.kind == MaterialKind::network) {
        for (const Measurement& table : experiment.measurements) {
            if (is_flow(table.kind) && std::isnan(table.fluid_viscosity)) {
                throw InputError(
                    table.label +
                    " is of steady flow, which no simulated network of particles stands for: set kind in [material] to "
                    "newtonian or smooth, or fluid_viscosity of an oil in the measurement");
            }
        }
        return;
    }
    if (!experiment.structures.empty() || experiment.recipe) {
        refuse(experiment, "[structures] gives structures");
    }
    if (std::isfinite(experiment.sample.normal_stiffness)) {
        refuse(experiment, "sample.normal_stiffness is given");
    }
    for (const Measurement& table : experiment.measurements) {
        const bool flows = is_flow(table.kind);
        if (!flows && !is_step_test(table.kind) && (!has_moduli(table.kind) || table.kind == MeasurementKind::structure_series)) {
            refuse(experiment, table.label + " is a table of kind " + std::string(name_of(table.kind)));
        }
    }
}

}  // namespace coagula::diagnose
