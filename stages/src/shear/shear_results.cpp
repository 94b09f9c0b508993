// SPDX-License-Identifier: GPL-3.0-or-later
#include "shear_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::stages {

namespace {

using mechanics::LinearResponse;

const std::string linear_group = "/mechanics/linear/";

struct Orientation {
    std::string name;
    int normal;
    int direction;
};

/// Plate normal and shear direction of the six tests of the paper.
const std::array<Orientation, 6> orientations = {
    {{"xy", 0, 1}, {"xz", 0, 2}, {"yx", 1, 0}, {"yz", 1, 2}, {"zx", 2, 0}, {"zy", 2, 1}}};

/// Shear strains in Voigt order: place in LinearResponse::displacement.
struct Shear {
    std::string name;
    std::size_t place;
};
const std::array<Shear, 3> shears = {{{"yz", 3}, {"xz", 4}, {"xy", 5}}};

std::string solver_name(mechanics::LinearSolver solver) {
    return solver == mechanics::LinearSolver::iterative  ? "iterative"
           : solver == mechanics::LinearSolver::external ? "petsc"
                                                         : "direct";
}

void append_network(Results& results, const LinearResponse& response, double bond_tolerance,
                    const mechanics::LinearOptions& options) {
    results.push_back(io::text(linear_group + "method", "linear", "linear elastic response of the bonded network"));
    results.push_back(io::integer(linear_group + "contacts", response.contacts, "number of bonds"));
    results.push_back(io::integer(linear_group + "rattlers", response.rattlers, "particles that carry no load"));
    results.push_back(io::integer(linear_group + "floppy_modes", response.floppy_modes,
                                  "zero-energy modes of the load-bearing particles; -1: not counted"));
    results.push_back(io::scalar(linear_group + "bond_tolerance", bond_tolerance, "1",
                                 "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(
        io::scalar(linear_group + "particle_stiffness/normal", options.normal_stiffness, "N/m", "stiffness of one particle"));
    results.push_back(
        io::scalar(linear_group + "particle_stiffness/shear", options.shear_stiffness, "N/m", "stiffness of one particle"));
    results.push_back(io::scalar(linear_group + "contact_stiffness/normal", response.contact_normal_stiffness, "N/m",
                                 "stiffness of a contact: two particles in series"));
    results.push_back(io::scalar(linear_group + "contact_stiffness/shear", response.contact_shear_stiffness, "N/m",
                                 "stiffness of a contact: two particles in series"));
}

void append_boundary(Results& results, const mechanics::LinearOptions& options) {
    const bool periodic = options.held.empty();
    results.push_back(io::text(linear_group + "boundary", periodic ? "periodic" : "held surface",
                               periodic
                                   ? "the cell is periodic"
                                   : "particles at the free surface follow the strain, the stress is averaged over the others"));
    if (!periodic) {
        results.push_back(io::integer(linear_group + "held_particles", std::count(options.held.begin(), options.held.end(), true),
                                      "particles that follow the strain"));
        results.push_back(
            io::scalar(linear_group + "volume", options.volume, "m3", "volume of the other particles' Voronoi cells"));
    }
}

void append_moduli(Results& results, const LinearResponse& response) {
    const auto add = [&results](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(linear_group + name, value, "Pa", description));
    };
    add("storage_modulus/mean", response.mean_shear_modulus(), "shear modulus, mean of the six orientations");
    add("storage_modulus/std", response.shear_modulus_deviation(),
        "standard deviation over the orientations of this one structure");
    for (const Orientation& orientation : orientations) {
        add("storage_modulus/" + orientation.name, response.shear_modulus(orientation.normal, orientation.direction),
            "shear modulus, plate normal and shear direction " + orientation.name);
    }
    const std::string elastic = "0: an elastic network has no loss";
    add("loss_modulus/mean", 0, elastic);
    add("loss_modulus/std", 0, elastic);
    for (const Orientation& orientation : orientations) {
        add("loss_modulus/" + orientation.name, 0, elastic);
    }
    results.push_back(io::scalar(linear_group + "phase", 0, "rad", elastic));
    add("affine_modulus", response.mean_affine_modulus(), "shear modulus if all particles followed the strain, mean");
}

void append_tensors(Results& results, const LinearResponse& response) {
    results.push_back(io::matrix(linear_group + "elastic_tensor", response.elastic_tensor, "Pa", "Voigt order xx yy zz yz xz xy"));
    results.push_back(io::matrix(linear_group + "affine_tensor", response.affine_tensor, "Pa",
                                 "elastic tensor if all particles followed the strain"));
    results.push_back(io::vector(linear_group + "non_affinity", response.non_affinity, "1",
                                 "rms displacement beyond the affine one per unit strain over the mean radius, Voigt order"));
}

void append_solution(Results& results, const LinearResponse& response) {
    results.push_back(io::text(linear_group + "solver", solver_name(response.solver_used), "linear solver used"));
    results.push_back(io::integer(linear_group + "iterations", response.iterations,
                                  "iterations of the conjugate gradients, largest number over the strains"));
    const bool estimated = std::isfinite(response.modulus_error);
    results.push_back(io::scalar(linear_group + "modulus_error", estimated ? response.modulus_error : unset, "1",
                                 estimated ? "estimated relative error of the moduli from stopping the iteration"
                                           : "NaN: the residual was met before the error of the moduli could be estimated"));
    results.push_back(io::scalar(linear_group + "residual", response.residual, "1", "|f - K u| / |f|, largest over the strains"));
}

}  // namespace

Results datasets_of(const LinearResponse& response, double bond_tolerance, const mechanics::LinearOptions& options) {
    Results results;
    append_network(results, response, bond_tolerance, options);
    append_boundary(results, options);
    append_moduli(results, response);
    append_tensors(results, response);
    append_solution(results, response);
    return results;
}

std::vector<io::ParticleField> fields_of(const LinearResponse& response) {
    std::vector<io::ParticleField> fields;
    for (const Shear& shear : shears) {
        fields.push_back({"nonaffine_displacement_" + shear.name, response.displacement.at(shear.place), "m",
                          "displacement beyond the affine one per unit shear strain " + shear.name});
        fields.push_back(
            {"rotation_" + shear.name, response.rotation.at(shear.place), "rad", "rotation per unit shear strain " + shear.name});
    }
    return fields;
}

void append_relaxation(const std::string& method_group, Results& results, std::vector<io::ParticleField>& fields,
                       const mechanics::RelaxedNetwork& rest) {
    const double moved = std::sqrt(rest.displacement.squaredNorm() / static_cast<double>(rest.packing.size()));
    results.push_back(io::scalar(method_group + "/relaxation/rms_displacement", moved, "m",
                                 "rms displacement of the particles before the shear"));
    results.push_back(io::scalar(method_group + "/relaxation/rms_force", rest.rms_force, "1",
                                 "rms force left over normal contact stiffness times mean radius"));
    results.push_back(io::integer(method_group + "/relaxation/iterations", rest.iterations, "iterations of the relaxation"));
    fields.push_back({"relaxation_displacement", rest.displacement, "m", "displacement by the relaxation before the shear"});
}

Table table_of(const LinearResponse& response) {
    std::string planes;
    for (const auto& [normal, direction] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
        planes += (planes.empty() ? "" : ", ") + with_unit(response.shear_modulus(normal, direction), "Pa");
    }
    const std::string floppy = response.floppy_modes < 0 ? "not counted" : std::to_string(response.floppy_modes);
    return {{"bonds", std::to_string(response.contacts)},
            {"rattlers", std::to_string(response.rattlers)},
            {"floppy modes", floppy},
            {"contact stiffness", with_unit(response.contact_normal_stiffness, "N/m") + " normal, " +
                                      with_unit(response.contact_shear_stiffness, "N/m") + " shear"},
            {"shear modulus G'", with_unit(response.mean_shear_modulus(), "Pa") + " +- " +
                                     with_unit(response.shear_modulus_deviation(), "Pa") +
                                     "   (+- is the standard deviation over six orientations)"},
            {"  in xy, xz, yz", planes},
            {"affine shear modulus", with_unit(response.mean_affine_modulus(), "Pa")},
            {"solver", solver_name(response.solver_used) + ", residual " + with_unit(response.residual, "1")}};
}

}  // namespace coagula::stages
