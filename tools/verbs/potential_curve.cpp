// SPDX-License-Identifier: GPL-3.0-or-later
#include "potential_curve.hpp"

#include "cli/report.hpp"
#include "potential_picture.hpp"

#include <coagula/stages/bond_potential.hpp>
#include <coagula/stages/generate.hpp>
#include <coagula/stages/output_file.hpp>

#include <cmath>

namespace coagula::tools {

using namespace generators;

namespace {

/// Gaps of a curve: in logarithmic steps, or in equal ones through a well of the laws themselves, whose repulsion begins below
/// zero.
std::vector<double> gaps_of(const PairPotential& potential, double farthest) {
    constexpr int intervals = 200;
    const double rest = potential.contact().equilibrium_gap;
    std::vector<double> gaps;
    if (potential.has_well()) {
        const double first = rest - 1.2 * (rest - potential.cut_gap());
        for (int point = 0; point <= intervals; ++point) {
            gaps.push_back(first + (farthest - first) * point / intervals);
        }
        return gaps;
    }
    const double first = 0.5 * rest;
    const double ratio = std::pow(farthest / first, 1.0 / intervals);
    for (double gap = first; gap < farthest * 1.000001; gap *= ratio) {
        gaps.push_back(gap);
    }
    return gaps;
}

}  // namespace

void report_potential(const Arguments& arguments, const PairPotential& potential, double radius) {
    const bool well = potential.has_well();
    const double range = well ? stages::pair_forces(arguments).depletion->range_of(radius) : radius;
    const double farthest = arguments.has("cutoff-gap") ? arguments.quantity("cutoff-gap") : range;
    const double thermal = boltzmann_constant * arguments.quantity("temperature");
    PotentialCurve curve{.gap = gaps_of(potential, farthest), .energy = {}, .force = {}, .logarithmic = !well};
    for (const double gap : curve.gap) {
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
    Json json = {{"barrier_height_kT", potential.barrier_height(farthest) / thermal},
                 {"barrier", extreme(potential.barrier(farthest))},
                 {"secondary_minimum", extreme(potential.secondary_minimum(farthest))},
                 {"contact", extreme(potential.contact_minimum())},
                 {"cut_gap", potential.cut_gap()},
                 {"contact_stiffness", potential.contact().stiffness},
                 {"curve", {{"gap", curve.gap}, {"energy_kT", curve.energy}, {"force", curve.force}}}};
    stages::Findings bonds;
    if (well) {
        bonds = stages::bond_findings(potential, radius, arguments.quantity("temperature"), range);
        json.update(to_json(bonds.results, bonds.group));
    }
    report::check_finite(json);
    if (arguments.has("picture")) {
        check_picture_name(arguments.text("picture"));
        check_output(arguments, arguments.text("picture"));
        draw_potential(arguments.text("picture"), curve, arguments.flag("force"));
    }
    Table table = {{"barrier height", with_unit(potential.barrier_height(farthest) / thermal, "kT")},
                   {"barrier", described(potential.barrier(farthest))},
                   {"secondary minimum", described(potential.secondary_minimum(farthest))},
                   {"contact", described(potential.contact_minimum())},
                   {"elastic below a gap of", with_unit(potential.cut_gap(), "m")}};
    table.insert(table.end(), bonds.table.begin(), bonds.table.end());
    table.emplace_back("gap [m]", "energy [kT], force [N]");
    for (std::size_t row = 0; row < curve.gap.size(); row += 5) {
        table.emplace_back(with_unit(curve.gap[row], "1"),
                           with_unit(curve.energy[row], "1") + ", " + with_unit(curve.force[row], "1"));
    }
    report(arguments, json, table);
}

}  // namespace coagula::tools
