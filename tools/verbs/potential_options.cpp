#include "potential_options.hpp"

#include "cli/output_file.hpp"
#include "potential_picture.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/generators/coagulation.hpp>
#include <coagula/io/table.hpp>

#include <cmath>
#include <stdexcept>

namespace coagula::tools {

namespace {

using namespace generators;

double thermal_energy(const Arguments& arguments) {
    return boltzmann_constant * arguments.quantity("temperature");
}

double screening_length(const Arguments& arguments) {
    if (!arguments.has("ionic-strength")) {
        return arguments.has("debye-length") ? arguments.quantity("debye-length") : 10e-9;
    }
    if (arguments.has("debye-length")) {
        throw InputError("--debye-length and --ionic-strength both set the Debye length: give one of them");
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

std::vector<PairLaw> dlvo_laws(const Arguments& arguments, const PairRadii& radii, double surface_potential) {
    const DoubleLayer layer{.surface_potential = surface_potential,
                            .debye_length = screening_length(arguments),
                            .relative_permittivity = arguments.quantity("permittivity"),
                            .temperature = arguments.quantity("temperature"),
                            .valency = static_cast<int>(arguments.count("valency"))};
    std::vector<PairLaw> laws{HamakerAttraction(arguments.quantity("hamaker-constant"), radii)};
    if (arguments.text("double-layer") == "superposition") {
        laws.emplace_back(LinearSuperposition(layer, radii));
    } else {
        laws.emplace_back(HoggHealyFuerstenau(layer, radii));
    }
    return laws;
}

}  // namespace

std::vector<Option> potential_options() {
    return {
        quantity("surface-potential", "V", "surface potential of the particles; required unless a table gives the potential", "",
                 within(-1, 1)),
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
        quantity("contact-stiffness", "N/m", "stiffness of the elastic contact below a cut-off gap; 4e5 kB T/R^2 when not given",
                 "", physical::stiffness),
        quantity("equilibrium-gap", "m", "gap at which two particles in contact rest; 0.004 R when not given", "",
                 physical::length),
        quantity("cutoff-gap", "m", "gap beyond which there are no forces; R when not given", "", physical::length),
        quantity("temperature", "K", "temperature of the suspension", "293K", within(1, 1e4)),
        flag("potential-curve", "print the potential against the gap and run nothing"),
        writes(text("picture", "FILE", "with --potential-curve: draw the curve into this file, .svg, .png or .pdf"))};
}

PairPotential make_potential(const Arguments& arguments, double radius, std::optional<double> surface_potential) {
    const PairRadii radii{radius, radius};
    std::vector<PairLaw> laws;
    if (arguments.has("potential-table") && !surface_potential) {
        if (arguments.has("surface-potential")) {
            throw InputError("--potential-table and --surface-potential exclude each other");
        }
        laws.emplace_back(read_potential(arguments.text("potential-table")));
    } else {
        if (!surface_potential && !arguments.has("surface-potential")) {
            throw InputError("coagula generate brownian needs --surface-potential or --potential-table");
        }
        laws = dlvo_laws(arguments, radii, surface_potential ? *surface_potential : arguments.quantity("surface-potential"));
    }
    if (arguments.has("yukawa-energy") != arguments.has("yukawa-length")) {
        throw InputError("--yukawa-energy and --yukawa-length need each other");
    }
    if (arguments.has("yukawa-energy")) {
        laws.emplace_back(Yukawa(arguments.quantity("yukawa-energy"), arguments.quantity("yukawa-length"), radii));
    }
    const ElasticContact firm = firm_contact(radius, arguments.quantity("temperature"));
    return {std::move(laws),
            {arguments.optional_quantity("contact-stiffness").value_or(firm.stiffness),
             arguments.optional_quantity("equilibrium-gap").value_or(firm.equilibrium_gap)}};
}

void report_potential(const Arguments& arguments, const PairPotential& potential, double radius) {
    const double farthest = arguments.has("cutoff-gap") ? arguments.quantity("cutoff-gap") : radius;
    const double thermal = thermal_energy(arguments);
    const double first = 0.5 * potential.contact().equilibrium_gap;
    const double ratio = std::pow(farthest / first, 1.0 / 200);
    PotentialCurve curve;
    for (double gap = first; gap < farthest * 1.000001; gap *= ratio) {
        curve.gap.push_back(gap);
        curve.energy.push_back(potential.energy(gap) / thermal);
        curve.force.push_back(potential.force(gap));
    }
    const auto extreme = [&](const std::optional<Extreme>& found) {
        return found ? Json{{"gap", found->gap}, {"energy_kT", found->energy / thermal}} : Json(nullptr);
    };
    const auto described = [&](const std::optional<Extreme>& found) {
        return found ? with_unit(found->energy / thermal, "kT") + " at a gap of " + with_unit(found->gap, "m")
                     : std::string("none");
    };
    const Json json = {{"barrier_height_kT", potential.barrier_height(farthest) / thermal},
                       {"barrier", extreme(potential.barrier(farthest))},
                       {"secondary_minimum", extreme(potential.secondary_minimum(farthest))},
                       {"contact", extreme(potential.contact_minimum())},
                       {"cut_gap", potential.cut_gap()},
                       {"contact_stiffness", potential.contact().stiffness},
                       {"curve", {{"gap", curve.gap}, {"energy_kT", curve.energy}, {"force", curve.force}}}};
    check_finite(json);
    if (arguments.has("picture")) {
        check_picture_name(arguments.text("picture"));
        check_output(arguments, arguments.text("picture"));
        draw_potential(arguments.text("picture"), curve, arguments.flag("force"));
    }
    Table table = {{"barrier height", with_unit(potential.barrier_height(farthest) / thermal, "kT")},
                   {"barrier", described(potential.barrier(farthest))},
                   {"secondary minimum", described(potential.secondary_minimum(farthest))},
                   {"contact", described(potential.contact_minimum())},
                   {"elastic below a gap of", with_unit(potential.cut_gap(), "m")},
                   {"gap [m]", "energy [kT], force [N]"}};
    for (std::size_t row = 0; row < curve.gap.size(); row += 5) {
        table.emplace_back(with_unit(curve.gap[row], "1"),
                           with_unit(curve.energy[row], "1") + ", " + with_unit(curve.force[row], "1"));
    }
    report(arguments, json, table);
}

}  // namespace coagula::tools
