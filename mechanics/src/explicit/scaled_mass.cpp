// SPDX-License-Identifier: GPL-3.0-or-later
#include "scaled_mass.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::mechanics {

namespace {

constexpr double safety = 0.8;
/// Contacts are strained up to this many times as much as the sample: how stiff a contact becomes whose stiffness grows with load.
constexpr double strain_concentration = 10;
constexpr double inertia = 0.4;  ///< of a solid sphere over m r^2

double or_zero(double value) {
    return std::isnan(value) ? 0.0 : value;
}

/// Force per displacement and moment per rotation of a bond, largest in the run.
struct Rigidity {
    double normal = 0;  ///< [N/m], or [N s/m] of dashpots
    double shear = 0;
    double moment = 0;  ///< [N m]
};

Rigidity rigidity(const GeneralContact& law, const Eigen::Vector3d& branch, double first, double second,
                  const RheometerOptions& options) {
    const double distance = branch.norm();
    const ContactMemory memory = law.make_bond(branch, first, second, options.unstressed_as_found ? distance : first + second);
    const double overlap = std::abs(memory.rest_length - distance) + strain_concentration * options.amplitude * distance;
    const NormalResponse response = law.normal(overlap, first * second / (first + second), true);
    const ContactModel& model = law.model();
    return {response.stiffness + or_zero(model.normal_maxwell_stiffness),
            response.shear_stiffness + or_zero(model.shear_maxwell_stiffness),
            law.age_factor() * std::max(or_zero(model.bending_stiffness), or_zero(model.twisting_stiffness))};
}

/// Largest row sum of the matrix over the mass, Gershgorin's bound, if a bond has rigidity `of(bond)`; for mean radius and unit
/// mass.
template <class Of>
double row_bound(const Packing& packing, const ContactNetwork& bonds, Of&& of) {
    const double mean = mean_radius(packing);
    Eigen::VectorXd translation = Eigen::VectorXd::Zero(packing.size());
    Eigen::VectorXd rotation = translation;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Rigidity k = of(bond);
        for (int end = 0; end < 2; ++end) {
            const Index particle = bonds.ends(end, bond);
            const double r = packing.radii[particle];
            const double relative_mass = std::pow(r / mean, 3);
            const double coupling = 2 * k.shear / std::sqrt(inertia);  // of turns, as arc lengths over sqrt(inertia)
            translation[particle] += (2 * std::max(k.normal, k.shear) + coupling) / relative_mass;
            rotation[particle] += (2 * (k.shear + k.moment / (r * r)) / inertia + coupling) / relative_mass;
        }
    }
    return std::max(translation.maxCoeff(), rotation.maxCoeff());
}

}  // namespace

double scaled_mass(const Packing& packing, const ContactNetwork& bonds, const GeneralContact& law, const RheometerOptions& options,
                   double time_step) {
    const auto radius = [&](int end, Index bond) { return packing.radii[bonds.ends(end, bond)]; };
    const double springs = row_bound(packing, bonds, [&](Index bond) {
        return rigidity(law, bonds.branch.col(bond), radius(0, bond), radius(1, bond), options);
    });
    const ContactModel& model = law.model();
    const double viscosity = or_zero(model.solvent_viscosity);
    const auto film = [&](Index bond) {
        const double reduced = radius(0, bond) * radius(1, bond) / (radius(0, bond) + radius(1, bond));
        return 6 * std::numbers::pi * viscosity * reduced * reduced / model.lubrication_gap;
    };
    const double drag = viscosity * (translation_drag(1) + rotation_drag(1) / inertia) * mean_radius(packing);
    const double dashpots =
        drag + row_bound(packing, bonds, [&](Index bond) {
            return Rigidity{or_zero(model.normal_viscosity) + or_zero(film(bond)), or_zero(model.shear_viscosity), 0};
        });
    const double bound = (0.25 * time_step * springs + 0.5 * dashpots) * time_step;
    // Without bonds nothing moves but overlapping particles.
    return std::max(bound, time_step * time_step * law.normal(mean_radius(packing), mean_radius(packing), true).stiffness) /
           (safety * safety);
}

double force_unit(const Packing& packing, const ContactNetwork& bonds, const GeneralContact& law, const RheometerOptions& options) {
    const double unloaded = law.normal(options.amplitude * mean_radius(packing), mean_radius(packing) / 2, true).stiffness;
    double stiffest = bonds.size() == 0 ? unloaded : 0.0;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const double first = packing.radii[bonds.ends(0, bond)];
        const double second = packing.radii[bonds.ends(1, bond)];
        stiffest = std::max(stiffest, rigidity(law, bonds.branch.col(bond), first, second, options).normal);
    }
    return stiffest * mean_radius(packing);
}

}  // namespace coagula::mechanics
