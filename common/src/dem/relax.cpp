// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/relax.hpp>

#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/dem/stepper.hpp>

#include <optional>
#include <string>

namespace coagula::dem {

namespace {

/// Time in units of sqrt(mass / normal stiffness), which is 1 s by the choice of the mass.
constexpr double time_step = 0.3;
constexpr double longest_time_step = 0.5;

void check_options(const RelaxOptions& options) {
    require_positive(options.normal_stiffness, "the normal contact stiffness", "N/m");
    require_non_negative(options.shear_stiffness, "the shear contact stiffness", "N/m");
    require_positive(options.tolerance, "the tolerance of the relaxation");
    require_non_negative(options.fire_below, "the force below which FIRE takes over");
    require(options.max_iterations > 0, "the relaxation needs at least one iteration");
}

/// Calls `advance()`, which returns the rms force, until that is small enough, also after all motion has been stopped: small forces
/// in passing do not count.
template <class Laws, class Advance>
Relaxation iterate(ParticleSystem& system, const Laws& laws, double force_unit, const RelaxOptions& options,
                   const Progress& progress, Advance&& advance) {
    const Eigen::Matrix3Xd at_rest = Eigen::Matrix3Xd::Zero(3, system.size());
    Relaxation result;
    while (result.iterations < options.max_iterations && !result.converged) {
        result.rms_force = advance() / force_unit;
        if (result.rms_force < options.tolerance) {
            system.set_velocities(at_rest);
            system.set_spins(at_rest);
            compute_forces(system, laws);
            result.rms_force = rms_force(system) / force_unit;
            result.converged = result.rms_force < options.tolerance;
        }
        ++result.iterations;
        progress.update("relaxation", 0.0, "rms force " + to_text(result.rms_force));
    }
    result.packing = system.packing();
    result.bonds = system.bond_network();
    return result;
}

template <class BondLaw>
Relaxation relax_with(const Packing& packing, const ContactNetwork& bonds, const BondLaw& bond, const RelaxOptions& options,
                      const Progress& progress) {
    const double radius = mean_radius(packing);
    ParticleSystem system(packing.cell, packing.positions, packing.radii, 0.1 * radius);
    system.set_masses(Eigen::VectorXd::Constant(packing.size(), options.normal_stiffness));
    system.add_bonds(bonds);
    const Interactions<RepulsiveSpring, BondLaw> laws{RepulsiveSpring(options.normal_stiffness), bond, options.bond_on_touch};
    const double force_unit = options.normal_stiffness * radius;
    if (options.method == RelaxMethod::fire) {
        Fire fire(system, laws, time_step, longest_time_step);
        return iterate(system, laws, force_unit, options, progress, [&] { return fire.iterate(); });
    }
    const bool stopped = options.method == RelaxMethod::stopped_steps;
    const StepOptions stepping{time_step, stopped ? 0.0 : options.damping, stopped};
    check(stepping);
    std::optional<Fire<Interactions<RepulsiveSpring, BondLaw>>> fire;
    return iterate(system, laws, force_unit, options, progress, [&] {
        if (fire) {
            return fire->iterate();
        }
        step(system, laws, stepping);
        const double force = rms_force(system);
        if (options.method == RelaxMethod::damped && force < options.fire_below * force_unit) {
            fire.emplace(system, laws, time_step, longest_time_step);
        }
        return force;
    });
}

}  // namespace

Relaxation relax(const Packing& packing, const ContactNetwork& bonds, const RelaxOptions& options, const Progress& progress) {
    check_options(options);
    if (options.shear_stiffness > 0) {
        return relax_with(packing, bonds, BondedContact(options.normal_stiffness, options.shear_stiffness), options, progress);
    }
    return relax_with(packing, bonds, BondSpring(options.normal_stiffness), options, progress);
}

}  // namespace coagula::dem
