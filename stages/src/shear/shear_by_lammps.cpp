// SPDX-License-Identifier: GPL-3.0-or-later
#include "shear_by_lammps.hpp"

#include "engine/lammps_bodies.hpp"
#include "engine/lammps_process.hpp"
#include "network_keys.hpp"
#include "orientation_list.hpp"
#include "progress_part.hpp"

#include <coagula/stages/scratch_folder.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>

namespace coagula::stages {

namespace {

// Nearly floppy parts of a network move by thousands of times the strain: it is so small that they stay linear.
constexpr double strain = 1e-8;

// A drag at rate g stops what is faster than g / 2 within a few 1 / g. Stage by stage it is halved, and comes to slower motion.
constexpr double first_rate = 0.2;
constexpr double stage_duration = 3;  // over 1 / g
constexpr int most_stages = 17;
// The network is at rest when the modulus changes by less than the first of these in two stages in turn, or the second in one.
constexpr double small_change = 5e-4;
constexpr double tiny_change = 5e-5;
constexpr double affine_tolerance = 1e-4;  // relative, to the affine modulus as it is computed here

bool is_same_plane(const mechanics::ShearOrientation& one, const mechanics::ShearOrientation& other) {
    return std::minmax(one.normal, one.direction) == std::minmax(other.normal, other.direction);
}

std::vector<mechanics::ShearOrientation> planes_of(const std::vector<mechanics::ShearOrientation>& orientations) {
    std::vector<mechanics::ShearOrientation> planes;
    for (const mechanics::ShearOrientation& orientation : orientations) {
        if (std::none_of(planes.begin(), planes.end(), [&](const auto& plane) { return is_same_plane(plane, orientation); })) {
            planes.push_back(orientation);
        }
    }
    return planes;
}

/// Engineering shear strain, applied symmetrically.
Eigen::Matrix3d deformation_of(const mechanics::ShearOrientation& plane) {
    Eigen::Matrix3d deformation = Eigen::Matrix3d::Identity();
    deformation(plane.normal, plane.direction) = deformation(plane.direction, plane.normal) = strain / 2;
    return deformation;
}

ContactRatios ratios_of(const ContactModel& model, double length) {
    const auto moment = [&](double stiffness) {  // of a contact, not of a particle as the springs
        return std::isnan(stiffness) ? 0.0 : stiffness / (0.5 * model.normal_stiffness * length * length);
    };
    return {model.shear_stiffness / model.normal_stiffness, moment(model.bending_stiffness), moment(model.twisting_stiffness)};
}

void check_packing(const Packing& packing, const ContactNetwork& bonds) {
    if (!packing.cell.is_periodic()) {
        throw InputError(
            "LAMMPS shears a packing in a periodic cell only, but this one has a free surface: take the linear method");
    }
    const double longest = bonds.size() > 0 ? bonds.branch.colwise().norm().maxCoeff() : 0;
    if (longest >= packing.cell.half_period()) {
        throw InputError(
            "the cell is so small that particles meet images of each other, between which LAMMPS cannot tell: take "
            "the builtin engine");
    }
}

class Settling {
public:
    Settling(const Engine& engine, const ContactModel& model, const Packing& packing, const ContactNetwork& bonds)
        : packing_(packing),
          bonds_(bonds),
          length_(mean_radius(packing)),
          ratios_(ratios_of(model, length_)),
          pressure_(0.5 * model.normal_stiffness / length_),
          process_(engine, scratch_.path()) {}

    LammpsShear shear(const mechanics::ShearOrientation& plane, const Progress& progress) {
        const LammpsBodies bodies = lammps_bodies(packing_, bonds_, ratios_, deformation_of(plane));
        write_for_lammps(scratch_.path() / "network.data", bodies.data);
        process_.send(lammps_bodies_setup(bodies, scratch_.path()));
        LammpsShear found{.plane = plane};
        found.affine_modulus = found.modulus = modulus(stage(bodies, first_rate, 0, {}));
        double rate = first_rate;
        int calm = 0;
        for (int number = 0; number < most_stages && calm < 2; ++number, rate /= 2) {
            const auto steps = static_cast<std::int64_t>(std::ceil(stage_duration / (rate * lammps_settling_step)));
            const LammpsRest rest = stage(bodies, rate, steps, [&] {
                progress.update("", static_cast<double>(number) / most_stages, std::to_string(found.steps) + " steps");
            });
            found.steps += steps;
            found.change = std::abs(modulus(rest) - found.modulus) / std::abs(modulus(rest));
            found.modulus = modulus(rest);
            const Eigen::Matrix3d stress = bodies.axes * rest.stress * bodies.axes.transpose();
            found.stress_modulus = stress(plane.normal, plane.direction) / strain * pressure_;
            calm = found.change < tiny_change ? 2 : found.change < small_change ? calm + 1 : 0;
        }
        if (calm < 2) {
            throw std::runtime_error("LAMMPS did not bring the network to rest in " + std::to_string(found.steps) +
                                     " steps: its modulus still changes by " + with_unit(100 * found.change, "1") +
                                     " % while the drag is halved");
        }
        return found;
    }

    std::string finish() {
        process_.finish({});
        return process_.version();
    }

private:
    /// The energy at rest is the smallest: what has not yet settled enters it as a square.
    double modulus(const LammpsRest& rest) const {
        const double volume = packing_.cell.volume() / std::pow(length_, 3);
        return 2 * rest.energy / (strain * strain * volume) * pressure_;
    }

    LammpsRest stage(const LammpsBodies& bodies, double rate, std::int64_t steps, const std::function<void()>& meanwhile) {
        const std::filesystem::path file = scratch_.path() / "rest";
        process_.send(lammps_settle(bodies, rate, steps, file));
        process_.wait_for(file, meanwhile);
        const LammpsRest rest = read_lammps_rest(file);
        std::filesystem::remove(file);
        return rest;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    double length_;
    ContactRatios ratios_;
    double pressure_;  ///< unit of a modulus [Pa]
    ScratchFolder scratch_;
    LammpsProcess process_;
};

/// The energy of the network as LAMMPS read it, before anything moves, is known.
void check_affine(const LammpsShear& found, const mechanics::LinearResponse& linear) {
    const int voigt = 6 - found.plane.normal - found.plane.direction;
    const double expected = linear.affine_tensor(voigt, voigt);
    if (std::abs(found.affine_modulus - expected) > affine_tolerance * expected) {
        throw std::runtime_error("LAMMPS holds another network than it was given: its affine modulus is " +
                                 with_unit(found.affine_modulus, "Pa") + " instead of " + with_unit(expected, "Pa"));
    }
}

}  // namespace

const LammpsShear& LammpsShears::of(const mechanics::ShearOrientation& orientation) const {
    return *std::find_if(planes.begin(), planes.end(),
                         [&](const LammpsShear& shear) { return is_same_plane(shear.plane, orientation); });
}

void check_lammps_can_shear(const Arguments& arguments, const ContactModel& model) {
    if (arguments.given("boundary") && arguments.text("boundary") != "periodic") {
        throw InputError(arguments.spelled("boundary", arguments.text("boundary")) + " is not read with " +
                         arguments.spelled("engine", "lammps") + ", which shears the periodic cell");
    }
    if (arguments.text("rest-length") != "found") {
        throw InputError(arguments.spelled("rest-length", arguments.text("rest-length")) + " is not read with " +
                         arguments.spelled("engine", "lammps") + ", whose bonds bear no force where they are found");
    }
    const std::array springs = {&ContactModel::normal_stiffness, &ContactModel::shear_stiffness, &ContactModel::bending_stiffness,
                                &ContactModel::twisting_stiffness};
    for (const ContactParameter& parameter : contact_parameters()) {
        const bool is_spring = std::find(springs.begin(), springs.end(), parameter.value) != springs.end();
        if (!is_spring && parameter.is_set(model)) {
            throw InputError(arguments.text("model") + " has " + parameter.name + ", but with " +
                             arguments.spelled("engine", "lammps") +
                             " a bond has linear springs alone, against stretching, sliding, bending and twisting");
        }
    }
}

Findings shear_by_lammps(const ShearRun& run, const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    check_packing(packing, bonds);
    Results keys;
    const auto linear = append_network_keys(keys, "/mechanics/dem/", packing, bonds, run.model, progress);
    Settling settling(*run.lammps, run.model, packing, bonds);
    LammpsShears found{.planes = {}, .version = {}, .strain = strain};
    const std::vector<mechanics::ShearOrientation> planes = planes_of(run.orientations);
    for (std::size_t number = 0; number < planes.size(); ++number) {
        if (linear && !has_modulus(*linear, planes[number])) {
            found.planes.push_back({.plane = planes[number]});
            continue;
        }
        const Progress part = part_of(progress, "shearing", number, planes.size(), counted("plane", number + 1, planes.size()));
        found.planes.push_back(settling.shear(planes[number], part));
        if (linear) {
            check_affine(found.planes.back(), *linear);
        }
    }
    found.version = settling.finish();
    Findings findings = lammps_findings(run, bonds, found);
    std::move(keys.begin(), keys.end(), std::back_inserter(findings.results));
    if (linear) {
        append_reason(findings, packing, bonds, *linear);
    }
    return findings;
}

}  // namespace coagula::stages
