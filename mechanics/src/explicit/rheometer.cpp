// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/rheometer.hpp>

#include "plates.hpp"
#include "scaled_mass.hpp"
#include "shear_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace coagula::mechanics {

namespace {

using std::numbers::pi;

/// Part of the smallest period of the network that a neighbour list lasts does not matter: a tenth of a radius of room.
constexpr double skin = 0.1;

void check(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options,
           const std::vector<ShearOrientation>& orientations) {
    require(packing.cell.is_periodic(), "the packing has a free surface: the rheometer needs a periodic cell");
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require_positive(options.amplitude, "the amplitude of the strain");
    require_positive(options.frequency, "the frequency", "Hz");
    require_positive(options.density, "the density of the particles", "kg/m3");
    require_positive(options.plate_layers, "the number of layers of a plate");
    require_between(options.measurement_radius, 0, 0.5, "the radius of a measurement sphere over the height");
    require(options.oscillations > 0, "the rheometer needs at least one oscillation");
    const auto is_part = [](const CourseOscillation& one) { return one.part > 0 && one.part <= 1; };
    require(options.course.empty() || (options.course.size() == static_cast<std::size_t>(options.oscillations) &&
                                       std::all_of(options.course.begin(), options.course.end(), is_part)),
            "the course of the amplitudes must have one part above 0 and up to 1 for every oscillation");
    require(options.measurement_spheres >= 0, "the number of measurement spheres must not be negative");
    require(options.damping >= 0 && options.damping < 1,
            "the damping coefficient is " + to_text(options.damping) + ", but must lie in [0, 1)");
    const int samples = options.samples_per_oscillation;
    require(samples >= 8 && samples % 4 == 0, "the samples per oscillation must be a multiple of 4 and at least 8");
    require(options.steps_per_oscillation >= 100 && options.steps_per_oscillation % samples == 0,
            "the steps per oscillation must be at least 100 and a multiple of the " + std::to_string(samples) +
                " samples per oscillation");
    for (const ShearOrientation& orientation : orientations) {
        const auto is_axis = [](int axis) { return axis >= 0 && axis < 3; };
        require(is_axis(orientation.normal) && is_axis(orientation.direction) && orientation.normal != orientation.direction,
                "an orientation is named by two different axes of 0, 1, 2");
    }
}

/// Linear springs and strengths without anything else: the law of the paper.
bool is_simple(const ContactModel& model) {
    const auto all = contact_parameters();
    return std::none_of(all.begin(), all.end(), [&](const ContactParameter& parameter) {
        return parameter.is_set(model) && parameter.value != &ContactModel::normal_stiffness &&
               parameter.value != &ContactModel::shear_stiffness && parameter.value != &ContactModel::normal_strength &&
               parameter.value != &ContactModel::shear_strength;
    });
}

/// Force over stiffness; as long as one likes where there is no limit to the force or no spring.
double reach(double strength, double stiffness) {
    return std::isnan(strength) || stiffness == 0 ? std::numeric_limits<double>::max() : strength / stiffness;
}

SimpleInteractions simple_interactions(const GeneralContact& law) {
    const NormalResponse response = law.normal(0, 1, true);
    return {{RepulsiveSpring(response.stiffness), BondedContact(response.stiffness, response.shear_stiffness)},
            law,
            reach(law.model().normal_strength, response.stiffness),
            // A square that stays finite.
            std::min(reach(law.model().shear_strength, response.shear_stiffness), 1e100)};
}

/// One run per orientation, from the start or from a checkpoint.
class Rheometer {
public:
    Rheometer(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options, const Progress& progress,
              const RheometerControl& control)
        : packing_(packing),
          bonds_(bonds),
          options_(options),
          progress_(progress),
          control_(control),
          law_(options.model),
          time_step_(1 / (options.frequency * options.steps_per_oscillation)) {}

    RheometerResult run(const std::vector<ShearOrientation>& orientations) {
        RheometerResult result;
        if (control_.resume != nullptr) {
            result.runs = control_.resume->finished;
        }
        while (result.runs.size() < orientations.size()) {
            const bool resumes = control_.resume != nullptr && result.runs.size() == control_.resume->finished.size();
            result.runs.push_back(run_one(orientations[result.runs.size()], resumes, result.runs));
        }
        return describe(std::move(result));
    }

private:
    RheometerRun run_one(const ShearOrientation& orientation, bool resumes, const std::vector<RheometerRun>& finished) const {
        const MountedSample mounted = mount(packing_, bonds_, options_, orientation);
        if (is_simple(options_.model)) {
            return run_with(mounted, orientation, simple_interactions(law_), false, resumes, finished);
        }
        const dem::GeneralInteractions laws{law_, time_step_, solvent(mounted, orientation)};
        return run_with(mounted, orientation, laws, true, resumes, finished);
    }

    dem::Solvent solvent(const MountedSample& mounted, const ShearOrientation& orientation) const {
        const ContactModel& model = options_.model;
        dem::Solvent fluid;
        fluid.viscosity = std::isnan(model.solvent_viscosity) ? 0.0 : model.solvent_viscosity;
        fluid.lubrication_cutoff = film_reach();
        fluid.lubrication_gap = model.lubrication_gap;
        fluid.direction = orientation.direction;
        fluid.normal = orientation.normal;
        fluid.cell_moves = !mounted.has_plates();
        fluid.resting_plane = mounted.bottom;
        return fluid;
    }
    double film_reach() const { return std::isnan(options_.model.lubrication_cutoff) ? 0.0 : options_.model.lubrication_cutoff; }

    template <class Laws>
    RheometerRun run_with(const MountedSample& mounted, const ShearOrientation& orientation, const Laws& laws, bool general,
                          bool resumes, const std::vector<RheometerRun>& finished) const {
        const double force_scale = force_unit(packing_, bonds_, law_, options_);
        ShearRun<Laws> shear(mounted, options_, orientation, make_system(mounted, general), laws, time_step_, force_scale,
                             progress_);
        if (resumes) {
            shear.resume(*control_.resume);
        } else {
            shear.rest();
        }
        shear.oscillate([&](const dem::ParticleState& state, const RheometerRun& current) {
            if (control_.on_checkpoint) {
                control_.on_checkpoint({finished, current, state});
            }
        });
        if (options_.compare_with_rest) {
            shear.compare_with_rest();
        }
        return shear.result();
    }

    dem::ParticleSystem make_system(const MountedSample& mounted, bool general) const {
        const Packing& all = mounted.packing;
        const double radius = mean_radius(packing_);
        dem::ParticleSystem system(all.cell, all.positions, all.radii, skin * radius + film_reach());
        system.keep_listed(film_reach());
        system.set_masses(mass() * (all.radii / radius).array().cube().matrix());
        system.use_general_contacts(general);
        system.add_bonds(mounted.bonds, [&](const Eigen::Vector3d& branch, double first, double second) {
            return law_.make_bond(branch, first, second, options_.unstressed_as_found ? branch.norm() : first + second);
        });
        return system;
    }

    /// The scaled mass of a particle of mean radius [kg].
    double mass() const { return scaled_mass(packing_, bonds_, law_, options_, time_step_); }

    RheometerResult describe(RheometerResult result) const {
        const double radius = mean_radius(packing_);
        const NormalResponse contact = law_.normal(0, radius / 2, true);
        result.contacts = bonds_.size();
        result.contact_normal_stiffness = contact.stiffness;
        result.contact_shear_stiffness = contact.shear_stiffness;
        result.time_step = time_step_;
        result.mass_scaling = mass() / (4 * pi / 3 * radius * radius * radius * options_.density);
        const double stiffness = force_unit(packing_, bonds_, law_, options_) / radius;
        result.inertial_number = 2 * pi * options_.frequency * options_.amplitude * std::sqrt(mass() / stiffness);
        return result;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    const RheometerOptions& options_;
    const Progress& progress_;
    const RheometerControl& control_;
    GeneralContact law_;
    double time_step_;
};

using Value = double Oscillation::*;

double mean_of(const std::vector<RheometerRun>& runs, Value value) {
    double sum = 0;
    for (const RheometerRun& run : runs) {
        sum += run.oscillations.back().*value;
    }
    return sum / static_cast<double>(runs.size());
}

double deviation_of(const std::vector<RheometerRun>& runs, Value value) {
    const double mean = mean_of(runs, value);
    double sum = 0;
    for (const RheometerRun& run : runs) {
        const double difference = run.oscillations.back().*value - mean;
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(runs.size()));
}

}  // namespace

std::vector<ShearOrientation> uniaxial_orientations() {
    return {{0, 0}, {1, 1}, {2, 2}};
}

std::vector<ShearOrientation> all_orientations() {
    return {{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}};
}

RheometerResult run_rheometer(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options,
                              const std::vector<ShearOrientation>& orientations, const Progress& progress,
                              const RheometerControl& control) {
    check(packing, bonds, options, orientations);
    return Rheometer(packing, bonds, options, progress, control).run(orientations);
}

double RheometerResult::storage_modulus() const {
    return mean_of(runs, &Oscillation::storage_modulus);
}
double RheometerResult::storage_deviation() const {
    return deviation_of(runs, &Oscillation::storage_modulus);
}
double RheometerResult::loss_modulus() const {
    return mean_of(runs, &Oscillation::loss_modulus);
}
double RheometerResult::loss_deviation() const {
    return deviation_of(runs, &Oscillation::loss_modulus);
}
double RheometerResult::phase() const {
    return std::atan2(loss_modulus(), storage_modulus());
}

}  // namespace coagula::mechanics
