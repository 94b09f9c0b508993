// SPDX-License-Identifier: GPL-3.0-or-later
#include "shear_by_lammps.hpp"

#include "orientation_list.hpp"

#include <coagula/io/contact_model_file.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

const std::string lammps_group = "/mechanics/dem";

Eigen::VectorXd over_orientations(const ShearRun& run, const LammpsShears& found, double LammpsShear::*value) {
    Eigen::VectorXd values(static_cast<Index>(run.orientations.size()));
    std::transform(run.orientations.begin(), run.orientations.end(), values.begin(),
                   [&](const auto& orientation) { return found.of(orientation).*value; });
    return values;
}

double deviation(const Eigen::VectorXd& values) {
    return std::sqrt((values.array() - values.mean()).square().mean());
}

std::int64_t all_steps(const LammpsShears& found) {
    std::int64_t steps = 0;
    for (const LammpsShear& shear : found.planes) {
        steps += shear.steps;
    }
    return steps;
}

void append_network(Results& results, const ShearRun& run, const ContactNetwork& bonds) {
    const std::string in_series = "stiffness of a contact: two particles in series";
    results.push_back(
        io::text(lammps_group + "/method", "dem", "explicit discrete elements, a strain at which the network comes to rest"));
    results.push_back(io::text(lammps_group + "/boundary", "periodic", "the periodic cell is sheared"));
    results.push_back(io::integer(lammps_group + "/contacts", bonds.size(), "number of bonds"));
    results.push_back(io::scalar(lammps_group + "/bond_tolerance", run.bond_tolerance, "1",
                                 "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(io::text(lammps_group + "/model", io::contact_model_text(run.model), "the contact as a TOML file"));
    results.push_back(io::scalar(lammps_group + "/contact_stiffness/normal", 0.5 * run.model.normal_stiffness, "N/m", in_series));
    results.push_back(io::scalar(lammps_group + "/contact_stiffness/shear", 0.5 * run.model.shear_stiffness, "N/m", in_series));
}

void append_moduli(Results& results, const ShearRun& run, const Eigen::VectorXd& moduli) {
    const auto add = [&](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(lammps_group + "/storage_modulus/" + name, value, "Pa", description));
    };
    add("mean", moduli.mean(), "shear modulus at rest, mean of the orientations");
    add("std", deviation(moduli), "standard deviation over the orientations of this one structure");
    std::string names;
    for (std::size_t k = 0; k < run.orientations.size(); ++k) {
        const std::string name = name_of(run.orientations[k]);
        add(name, moduli[static_cast<Index>(k)], "shear modulus at rest in the plane of " + name);
        names += (names.empty() ? "" : ",") + name;
    }
    results.push_back(io::text(lammps_group + "/orientations", names, "plate normal and shear direction, the order of all arrays"));
}

void append_settling(Results& results, const ShearRun& run, const LammpsShears& found) {
    results.push_back(
        io::scalar(lammps_group + "/settling/strain", found.strain, "1", "shear strain at which the network came to rest"));
    results.push_back(io::integer(lammps_group + "/settling/steps", all_steps(found), "time steps of all planes together"));
    results.push_back(io::vector(lammps_group + "/settling/change", over_orientations(run, found, &LammpsShear::change), "1",
                                 "per orientation: relative change of the modulus while the drag was last halved"));
    results.push_back(io::vector(lammps_group + "/settling/stress_modulus",
                                 over_orientations(run, found, &LammpsShear::stress_modulus), "Pa",
                                 "per orientation: shear modulus from the stress at the end; storage_modulus is from the energy"));
}

}  // namespace

Findings lammps_findings(const ShearRun& run, const ContactNetwork& bonds, const LammpsShears& found) {
    Findings findings{.group = lammps_group, .results = {}};
    findings.engine = "LAMMPS " + found.version;
    findings.results.push_back(
        io::text(lammps_group + "/engine/name", findings.engine, "program that moved the particles, with its version"));
    append_network(findings.results, run, bonds);
    const Eigen::VectorXd moduli = over_orientations(run, found, &LammpsShear::modulus);
    append_moduli(findings.results, run, moduli);
    append_settling(findings.results, run, found);
    std::string each;
    for (std::size_t k = 0; k < run.orientations.size(); ++k) {
        each += (k == 0 ? "" : ", ") + name_of(run.orientations[k]) + " " + with_unit(moduli[static_cast<Index>(k)], "Pa");
    }
    const double change = over_orientations(run, found, &LammpsShear::change).maxCoeff();
    findings.table = {{"bonds", std::to_string(bonds.size())},
                      {"set-up", "periodic cell at a strain of " + with_unit(found.strain, "1") + ", brought to rest"},
                      {"storage modulus G'", with_unit(moduli.mean(), "Pa") + " +- " + with_unit(deviation(moduli), "Pa") +
                                                 "   (+- is the standard deviation over the orientations)"},
                      {"  each", each},
                      {"settling", std::to_string(all_steps(found)) + " time steps; G' changed by " + with_unit(100 * change, "1") +
                                       " % at most while the drag was last halved"},
                      {"moved by", findings.engine}};
    return findings;
}

}  // namespace coagula::stages
