// SPDX-License-Identifier: GPL-3.0-or-later
#include "potential.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/generators/coagulation.hpp>
#include <coagula/generators/depletion.hpp>
#include <coagula/io/table.hpp>

#include <stdexcept>
#include <utility>

namespace coagula::stages {

namespace {

using namespace generators;

// Range of the attraction by a polymer, over the radius of the particles. Shorter ranges are below the roughness of any surface.
// Polymers larger than 0.154 of the particles attract more than two at a time (Dijkstra, Brader, Evans, J. Phys.: Condens. Matter
// 11 (1999) 10079), and the well is no longer narrow beside the particles.
constexpr double smallest_range = 0.01;
constexpr double largest_range = 0.5;

double screening_length(const Arguments& arguments) {
    if (!arguments.has("ionic-strength")) {
        return arguments.has("debye-length") ? arguments.quantity("debye-length") : 10e-9;
    }
    if (arguments.has("debye-length")) {
        throw InputError(arguments.spelled("debye-length") + " and " + arguments.spelled("ionic-strength") +
                         " both set the Debye length: give one of them");
    }
    return debye_length(arguments.quantity("ionic-strength"), arguments.quantity("permittivity"),
                        arguments.quantity("temperature"));
}

TabulatedLaw read_potential(const std::string& path) {
    constexpr double largest = physical::length.high;
    const auto columns = io::read_table(path, {{.name = "gap", .unit = "m", .low = -largest, .high = largest},
                                               {.name = "energy", .unit = "J", .low = -1e-12, .high = 1e-12}});
    try {
        return {{columns[0].begin(), columns[0].end()}, {columns[1].begin(), columns[1].end()}};
    } catch (const std::invalid_argument& error) {
        throw InputError(path + ": " + error.what());
    }
}

Depletion depletion_of(const Arguments& arguments) {
    const auto one_of = [&](const std::string& first, const std::string& second) {
        if (arguments.has(first) == arguments.has(second)) {
            throw InputError(arguments.caller_of() + " needs " + arguments.spelled(first) + " or " + arguments.spelled(second) +
                             " with " + arguments.spelled("law", "depletion") + (arguments.has(first) ? ", but not both" : ""));
        }
    };
    one_of("depth", "polymer-concentration");
    one_of("attraction-range", "size-ratio");
    return {.depth = arguments.optional_quantity("depth"),
            .concentration = arguments.optional_quantity("polymer-concentration"),
            .range = arguments.optional_quantity("attraction-range"),
            .size_ratio = arguments.optional_quantity("size-ratio")};
}

DepletionAttraction attraction_of(const PairForces& forces, double radius) {
    const Depletion& given = *forces.depletion;
    const double range = given.range_of(radius);
    const double depth = given.depth ? *given.depth : depletion_depth(*given.concentration, range / (2 * radius));
    return {.depth = depth * boltzmann_constant * forces.layer.temperature,
            .range = range,
            .rest_gap = forces.equilibrium_gap.value_or(firm_contact(radius, forces.layer.temperature).equilibrium_gap),
            .contact_stiffness = forces.contact_stiffness};
}

std::vector<PairLaw> yukawa_law(const PairForces& forces, const PairRadii& radii) {
    return forces.yukawa_energy ? std::vector<PairLaw>{Yukawa(*forces.yukawa_energy, forces.yukawa_length, radii)}
                                : std::vector<PairLaw>{};
}

std::vector<PairLaw> dlvo_laws(const PairForces& forces, const PairRadii& radii, double surface_potential) {
    DoubleLayer layer = forces.layer;
    layer.surface_potential = surface_potential;
    std::vector<PairLaw> laws{HamakerAttraction(forces.hamaker_constant, radii)};
    if (forces.superposition) {
        laws.emplace_back(LinearSuperposition(layer, radii));
    } else {
        laws.emplace_back(HoggHealyFuerstenau(layer, radii));
    }
    return laws;
}

}  // namespace

std::vector<Option> potential_options() {
    std::vector<Option> options = {
        choice("law", {"dlvo", "depletion"}, "forces of the particles: DLVO, or attraction by a polymer that does not adsorb",
               "dlvo"),
        quantity("depth", "kT", "depth of the depletion attraction, such as 10kT", "", within(0.1, 1000)),
        quantity("polymer-concentration", "1",
                 "polymer in the liquid over its overlap concentration, from which the depth of the attraction follows", "",
                 within(1e-3, 100)),
        quantity("attraction-range", "m", "gap where the depletion attraction ends: twice the radius of gyration of the polymer",
                 "", physical::length),
        quantity("size-ratio", "1", "radius of gyration over the radius of the particles, from which the range follows", "",
                 within(smallest_range / 2, largest_range / 2)),
        quantity("surface-potential", "V", "surface potential of the particles; DLVO needs it unless a table gives the potential",
                 "", within(-1, 1)),
        quantity("debye-length", "m", "Debye length of the double layer; 10 nm when not given", "", physical::length),
        quantity("ionic-strength", "mol/m3", "ionic strength of a z:z electrolyte, from which the Debye length follows", "",
                 within(1e-9, 1e5)),
        choice("double-layer", {"superposition", "hogg-healy-fuerstenau"}, "approximation of the double-layer repulsion",
               "superposition"),
        quantity("hamaker-constant", "J", "Hamaker constant of the van der Waals attraction", "4.76e-20J", within(0, 1e-15)),
        quantity("permittivity", "1", "relative permittivity of the liquid", "81", within(1, 1e4)),
        count("valency", "valency of the ions of the electrolyte", "1", within(1, 10)),
        quantity("yukawa-energy", "J", "energy at contact of an additional Yukawa potential", "", within(-1e-15, 1e-15)),
        quantity("yukawa-length", "m", "screening length of the Yukawa potential", "", physical::length),
        reads(text("potential-table", "FILE", "CSV file with columns 'gap [unit],energy [unit]', in place of these potentials")),
        quantity(
            "contact-stiffness", "N/m",
            "stiffness of the elastic contact below a cut-off gap; when not given 4e5 kB T/R^2, with depletion that of the well",
            "", physical::stiffness),
        quantity("equilibrium-gap", "m", "gap at which two particles in contact rest; 0.004 R when not given", "",
                 physical::length),
        quantity("cutoff-gap", "m", "gap beyond which there are no forces; when not given R, with depletion twice the range", "",
                 physical::length),
        quantity("temperature", "K", "temperature of the suspension", "293K", within(1, 1e4)),
        flag("potential-curve", "print the potential against the gap and run nothing"),
        writes(text("picture", "FILE", "with --potential-curve: draw the curve into this file, .svg, .png or .pdf"))};
    read_only_with(options, {"depth", "polymer-concentration", "attraction-range", "size-ratio"}, "law", {"depletion"});
    not_read_with(options,
                  {"surface-potential", "debye-length", "ionic-strength", "double-layer", "hamaker-constant", "permittivity",
                   "valency", "potential-table"},
                  "law", {"depletion"});
    return options;
}

double Depletion::range_of(double radius) const {
    const double found = range ? *range : 2 * *size_ratio * radius;
    if (!(found >= smallest_range * radius && found <= largest_range * radius)) {
        throw InputError("the attraction ends at a gap of " + with_unit(found, "m") + ", which is " +
                         with_unit(found / radius, "1") + " radii of the particles: a depletion attraction by pairs may have " +
                         to_text(smallest_range) + " to " + to_text(largest_range));
    }
    return found;
}

PairForces pair_forces(const Arguments& arguments) {
    PairForces forces;
    if (arguments.text("law") == "depletion") {
        forces.depletion = depletion_of(arguments);
    } else if (arguments.has("potential-table")) {
        if (arguments.has("surface-potential")) {
            throw InputError(arguments.spelled("potential-table") + " and " + arguments.spelled("surface-potential") +
                             " exclude each other");
        }
        forces.table = read_potential(arguments.text("potential-table"));
    } else if (!arguments.has("surface-potential")) {
        throw InputError(arguments.caller_of() + " needs " + arguments.spelled("surface-potential") + ", " +
                         arguments.spelled("potential-table") + " or " + arguments.spelled("law", "depletion"));
    }
    if (arguments.has("yukawa-energy") != arguments.has("yukawa-length")) {
        throw InputError(arguments.spelled("yukawa-energy") + " and " + arguments.spelled("yukawa-length") + " need each other");
    }
    forces.layer = {.surface_potential = arguments.optional_quantity("surface-potential").value_or(unset),
                    .debye_length = screening_length(arguments),
                    .relative_permittivity = arguments.quantity("permittivity"),
                    .temperature = arguments.quantity("temperature"),
                    .valency = static_cast<int>(arguments.count("valency"))};
    forces.superposition = arguments.text("double-layer") == "superposition";
    forces.hamaker_constant = arguments.quantity("hamaker-constant");
    forces.yukawa_energy = arguments.optional_quantity("yukawa-energy");
    forces.yukawa_length = arguments.optional_quantity("yukawa-length").value_or(unset);
    forces.contact_stiffness = arguments.optional_quantity("contact-stiffness");
    forces.equilibrium_gap = arguments.optional_quantity("equilibrium-gap");
    return forces;
}

PairPotential make_potential(const PairForces& forces, double radius, std::optional<double> surface_potential) {
    const PairRadii radii{radius, radius};
    if (forces.depletion) {
        return depletion_potential(attraction_of(forces, radius), yukawa_law(forces, radii));
    }
    std::vector<PairLaw> laws;
    if (forces.table && !surface_potential) {
        laws.emplace_back(*forces.table);
    } else {
        laws = dlvo_laws(forces, radii, surface_potential.value_or(forces.layer.surface_potential));
    }
    for (PairLaw& law : yukawa_law(forces, radii)) {
        laws.push_back(std::move(law));
    }
    const ElasticContact firm = firm_contact(radius, forces.layer.temperature);
    return {std::move(laws),
            {forces.contact_stiffness.value_or(firm.stiffness), forces.equilibrium_gap.value_or(firm.equilibrium_gap)}};
}

PairPotential make_stable_potential(const PairForces& forces, double radius, double surface_potential) {
    if (!forces.depletion) {
        return make_potential(forces, radius, surface_potential);
    }
    const PairRadii radii{radius, radius};
    const DepletionAttraction attraction = attraction_of(forces, radius);
    std::vector<PairLaw> laws = yukawa_law(forces, radii);
    if (laws.empty()) {
        laws.emplace_back(Yukawa(0, attraction.range, radii));  // spheres that only touch
    }
    return {std::move(laws), {depletion_potential(attraction).contact().stiffness, attraction.rest_gap}};
}

}  // namespace coagula::stages
