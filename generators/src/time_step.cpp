// SPDX-License-Identifier: GPL-3.0-or-later
// The time step of Brownian dynamics from the potential: stability from the stiffest mode, accuracy from the barrier.
#include <coagula/generators/brownian_dynamics.hpp>

#include "reduced_units.hpp"
#include "step_scheme.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace coagula::generators {

namespace {

// In units of R^2/D, with lengths in R and energies in kB T.
constexpr double longest_time_step = 2e-5;
constexpr double longest_listed = 1.3e-4;   // a particle must stay within the skin of the neighbour list during a step
constexpr double far_time = 4e-5;           // over which far forces may be held
constexpr double far_steepness = 1000;      // of the force where it may be held that long
constexpr double longest_strain = 1e-3;     // of the flow in a step
constexpr double barrier_share = 1.0 / 28;  // of the square of the length of the barrier: a rate 2 % too small
constexpr double largest_cut = 0.1;         // gap up to which contacts may be elastic
constexpr int most_stages = 30;
constexpr double impassable = 25;  // height of a barrier in kB T
constexpr double longest_cutoff = 1000;
constexpr double shortest_time_step = 1e-15;
// Largest eigenvalue of the stiffness matrix of a contact network over the stiffness of one contact: 8 in a close-packed crystal,
// less in random packings.
constexpr double network_factor = 8;

void check(const BrownianOptions& options) {
    require_positive(options.temperature, "the temperature", "K");
    require_positive(options.viscosity, "the viscosity", "Pa s");
    require(options.slowing > 0 && options.slowing <= 1,
            "the hydrodynamic slowing is " + to_text(options.slowing) + ", but it must be above 0 and at most 1");
    if (!std::isnan(options.cutoff_gap)) {
        require_positive(options.cutoff_gap, "the cut-off gap", "m");
    }
}

/// Bound of the rates that sliding and rolling contacts add, for the twelve contacts that a sphere can have: tangential springs act
/// on translations (8 k per contact and direction, as network_factor has it) and on rotations, where mobility 3/4 and the sum over
/// twelve contacts of 1 - n n^T (8 in each direction) make 8 * 3/4 * 2 of particles that turn in the same sense; rolling springs
/// likewise, at the reduced radius 1/2.
double resistance_rate(const SpringRules& rules) {
    return (2 * network_factor + 12) * rules.tangential_stiffness + 12 * rules.rolling_stiffness / 4;
}

/// Largest gradient of the force that particles meet.
/// @param pressed whether a weight may press particles over the barrier.
double largest_steepness(const PairPotential& potential, const ReducedUnits& units, double closest_gap, double cutoff,
                         bool pressed) {
    const double height = potential.barrier_height(cutoff * units.length) / units.energy;
    const auto top = potential.barrier(cutoff * units.length);
    const bool contacts = pressed || height < impassable || (top && closest_gap < top->gap);
    double largest = contacts ? potential.contact().stiffness * units.length * units.length / units.energy : 0.0;
    const double lowest = contacts ? potential.cut_gap() / units.length : top->gap / units.length;
    for (double gap = lowest; gap < cutoff; gap += 1e-3) {
        // Attraction that grows towards contact, a negative stiffness, makes no step unstable.
        if (pressed || potential.energy(gap * units.length) / units.energy < impassable) {
            largest = std::max(largest, -force_slope(potential, units, gap));
        }
    }
    return largest;
}

/// Where the laws make the well in which contacts rest, the steepest fall of its attraction -V''/kB T: pairs leave the well and
/// enter it there as they pass the top of a barrier.
double steepest_fall(const PairPotential& potential, const ReducedUnits& units, double cutoff) {
    double steepest = 0;
    for (double gap = potential.contact().equilibrium_gap / units.length; gap < cutoff; gap += 1e-3) {
        steepest = std::max(steepest, force_slope(potential, units, gap));
    }
    return steepest;
}

/// sqrt(kB T / |V''|) at the top: over this length around it the barrier is passed.
double barrier_length(const PairPotential& potential, const ReducedUnits& units, double cutoff) {
    const auto top = potential.barrier(cutoff * units.length);
    return 1 / std::sqrt(force_slope(potential, units, top->gap / units.length));
}

StepScheme scheme_of(Integrator integrator, int stages) {
    return integrator == Integrator::euler ? euler_maruyama() : stabilised_scheme(stages);
}

}  // namespace

double mean_field_slowing(double volume_fraction) {
    require(volume_fraction >= 0 && volume_fraction < 0.64,
            "the volume fraction is " + to_text(volume_fraction) + ", but mean-field hydrodynamics hold for 0 to 0.64");
    return (1 - 1.56 * volume_fraction) * (1 - 0.27 * volume_fraction);
}

SpringRules spring_rules(const PairPotential& potential, const ContactResistance& resistance, const ReducedUnits& units) {
    const auto given = [](double value) { return !std::isnan(value); };
    require(
        !potential.has_well() || !given(resistance.tangential_stiffness),
        "contacts that resist sliding need an elastic contact at which they begin, but this potential rests in a well of its own");
    SpringRules rules;
    rules.reach = potential.cut_gap() / units.length;
    const double stiffness_unit = units.energy / (units.length * units.length);
    rules.normal_stiffness = potential.contact().stiffness / stiffness_unit;
    if (given(resistance.tangential_stiffness)) {
        rules.tangential_stiffness =
            require_positive(resistance.tangential_stiffness, "the tangential stiffness", "N/m") / stiffness_unit;
    }
    if (given(resistance.rolling_stiffness)) {
        require(rules.active(), "contacts that resist rolling need a tangential stiffness: without one they slide and never roll");
        rules.rolling_stiffness = require_positive(resistance.rolling_stiffness, "the rolling stiffness", "N/m") / stiffness_unit;
    }
    if (given(resistance.friction)) {
        require(rules.active(), "a coefficient of friction needs a tangential stiffness");
        rules.friction = require_non_negative(resistance.friction, "the coefficient of friction");
    }
    if (given(resistance.rolling_friction)) {
        require(rules.rolling_stiffness > 0, "a coefficient of rolling friction needs a rolling stiffness");
        rules.rolling_friction = require_non_negative(resistance.rolling_friction, "the coefficient of rolling friction");
    }
    return rules;
}

double force_slope(const PairPotential& potential, const ReducedUnits& units, double gap) {
    constexpr double half = 1e-5;
    const double change = potential.force((gap + half) * units.length) - potential.force((gap - half) * units.length);
    return change * units.length / units.energy / (2 * half);
}

ForceRanges choose_ranges(const PairPotential& potential, const ReducedUnits& units, const BrownianOptions& options) {
    constexpr double width = 0.06;
    const double cutoff = std::isnan(options.cutoff_gap) ? 1.0 : options.cutoff_gap / units.length;
    require(cutoff <= longest_cutoff, "the cut-off gap is " + to_text(options.cutoff_gap) + " m, which is " + to_text(cutoff) +
                                          " mean radii: it may be " + to_text(longest_cutoff) + " at most");
    require(cutoff > potential.cut_gap() / units.length, "the cut-off gap is " + to_text(options.cutoff_gap) +
                                                             " m, but contacts are elastic up to a gap of " +
                                                             to_text(potential.cut_gap()) + " m: take a longer cut-off");
    double start = 0.1;
    for (double gap = cutoff; gap > start; gap -= 1e-3) {
        if (std::abs(force_slope(potential, units, gap)) > far_steepness) {
            start = gap;
            break;
        }
    }
    // A short law is all near.
    const double end = start + width < 0.8 * cutoff ? start + width : cutoff;
    return {std::min(start, 0.8 * end), end, cutoff};
}

TimeStep choose_time_step(const PairPotential& potential, double mean_radius, double closest_gap, const BrownianOptions& options) {
    check(options);
    require_positive(mean_radius, "the mean radius", "m");
    require(potential.cut_gap() < largest_cut * mean_radius,
            "the contact is elastic up to a gap of " + to_text(potential.cut_gap()) +
                " m, but that must be less than a tenth of the mean radius: take a stiffer contact or a smaller equilibrium gap");
    const ReducedUnits units(mean_radius, options);
    const double cutoff = choose_ranges(potential, units, options).cutoff;
    const bool pressed = !std::isnan(options.sedimentation.gravity);
    const SpringRules rules = spring_rules(potential, options.resistance, units);
    const double rate = network_factor * largest_steepness(potential, units, closest_gap, cutoff, pressed) +
                        resistance_rate(rules) + (pressed ? rules.normal_stiffness : 0.0);  // of the walls
    const double height = potential.barrier_height(cutoff * units.length) / units.energy;
    TimeStep chosen;
    chosen.diffusion_time = units.time;

    double accurate = longest_time_step;
    chosen.reason = "the motion of free particles";
    if (height > 0 && height < impassable) {
        const double length = barrier_length(potential, units, cutoff);
        if (barrier_share * length * length < accurate) {
            accurate = barrier_share * length * length;
            chosen.reason = "the barrier";
        }
    }
    if (potential.has_well()) {
        const double fall = steepest_fall(potential, units, cutoff);
        if (barrier_share < accurate * fall) {
            accurate = barrier_share / fall;
            chosen.reason = "the width of the attraction";
        }
    }
    const double sheared = longest_strain / std::max(options.flow.largest_rate() * units.time, 1e-300);
    if (sheared < accurate) {
        accurate = sheared;
        chosen.reason = "the rate of strain";
    }
    const double stable = scheme_of(options.integrator, most_stages).stability / std::max(rate, 1.0);
    const double bound = std::min(stable, longest_listed);
    double step = accurate;
    if (0.5 * bound < step) {
        step = 0.5 * bound;
        chosen.reason = "the stiffness of the contacts";
    }
    if (!std::isnan(options.time_step)) {
        step = require_positive(options.time_step, "the time step", "s") / units.time;
        chosen.reason = "the option";
        require(step <= bound, "the time step is " + to_text(options.time_step) + " s, but the integrator is stable up to " +
                                   to_text(bound * units.time) + " s only");
        require(step <= sheared, "the time step is " + to_text(options.time_step) + " s, but the flow strains the box by " +
                                     to_text(longest_strain) + " in " + to_text(sheared * units.time) + " s: take a shorter step");
    }
    require(step >= shortest_time_step && std::isfinite(units.time) && units.time > 0,
            "the time step comes to " + to_text(step * units.time) + " s, which is " + to_text(step) +
                " of the diffusion time R^2/D: the contacts are too stiff for these particles");
    while (options.integrator == Integrator::stabilised && stabilised_scheme(chosen.stages).stability < step * rate) {
        ++chosen.stages;
    }
    chosen.time_step = step * units.time;
    chosen.stability_bound = bound * units.time;
    chosen.accuracy_bound = accurate * units.time;
    chosen.far_interval = std::max<std::int64_t>(1, static_cast<std::int64_t>(far_time / step));
    return chosen;
}

}  // namespace coagula::generators
