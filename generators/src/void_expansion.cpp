// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/void_expansion.hpp>

#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/dem/relax.hpp>
#include <coagula/common/dem/stepper.hpp>
#include <coagula/common/failures.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace coagula::generators {

namespace {

// The protocol, in units of the mean particle radius, the mass of a particle of that radius (voids too) and the stiffness of a
// contact.
constexpr dem::StepOptions stepping{.time_step = 0.5, .damping = 0.3};
constexpr double first_void_radius = 0.1;
constexpr double increment = 0.01;
constexpr double fine_increment = 0.005;
constexpr double steps_per_increment = 70;        // times the void radius expected at the end, from 1 to 3
constexpr double early_steps_per_increment = 35;  // the same, while voids are small and the particles have room
constexpr double early_growth = 0.5;              // of the void radius expected at the end, up to which it is early
constexpr double settled_force = 2e-5;            // rms force on the structure particles that ends an increment early
constexpr double trial_distance = 0.6;            // from the target coordination at which trials begin
constexpr double fine_overlap = 0.004;            // rms overlap, over the diameter, at which the fine increments begin
constexpr double pressed_overlap = 0.05;          // the same, at which trials begin however few contacts there are
constexpr double largest_overlap = 0.09;          // the same, at which the target is given up
constexpr double relaxed_overlap = 0.005;         // the same, that a relaxed packing may keep
constexpr double largest_volume = 1.5;            // of all spheres over that of the box, at which the target is given up
constexpr double fastest_rise = 0.12;             // of the coordination of trials by one fine increment
constexpr double start_time_step = 0.3;           // of moving the structure particles apart
constexpr double start_force = 1e-6;              // rms force at which the structure particles count as moved apart
constexpr double relaxed_force = 1e-7;            // rms force that ends a relaxation
constexpr double contacts_force = 1e-4;           // the same at which hardly any more contacts form
constexpr Index most_iterations = 100000;         // of a relaxation
constexpr double skin = 1.2;                      // of the neighbour list
constexpr double near_skin = 0.3;                 // of the pairs that are looked at in every step
constexpr double highest_target = 6;              // of the coordination: a rigid packing of frictionless spheres

using Laws = dem::Interactions<RepulsiveSpring, BondSpring>;
const Laws laws{RepulsiveSpring(1.0), BondSpring(1.0)};

/// Contacts among the structure particles, which come first in the system.
struct StructureContacts {
    double coordination = 0;
    double overlap_rms = 0;  ///< over the overlapping pairs, as a fraction of the mean diameter
};

StructureContacts measure(dem::ParticleSystem& system, Index structure, double tolerance) {
    system.refresh(2 * tolerance * system.radii().head(structure).maxCoeff());
    const dem::Slots& slots = system.slots();
    Index contacts = 0;
    Index overlapping = 0;
    double squared = 0;
    for (const dem::Chunk& chunk : system.chunks()) {
        for (const dem::SlotPair& pair : chunk.pairs) {
            const auto first = static_cast<std::size_t>(pair.first);
            const auto second = static_cast<std::size_t>(pair.second);
            if (slots.particle[first] >= structure || slots.particle[second] >= structure) {
                continue;
            }
            const dem::Quad image = slots.position[static_cast<std::size_t>(slots.source[second])] + slots.shift[second];
            const double distance = (image - slots.position[first]).head<3>().norm();
            const double reach = image[3] + slots.position[first][3];
            contacts += distance < (1 + tolerance) * reach ? 1 : 0;
            if (distance < reach) {
                ++overlapping;
                squared += 0.25 * (reach - distance) * (reach - distance);
            }
        }
    }
    return {2.0 * static_cast<double>(contacts) / static_cast<double>(structure),
            overlapping > 0 ? std::sqrt(squared / static_cast<double>(overlapping)) : 0.0};
}

std::string short_text(double value) {
    const long hundredths = std::lround(100 * value);
    const std::string cents = std::to_string(100 + hundredths % 100).substr(1);
    return std::to_string(hundredths / 100) + "." + cents;
}

/// One run of the method.
class Expansion {
public:
    Expansion(const VoidExpansionOptions& options, const Progress& progress)
        : options_(options), progress_(progress), structure_(options.particles), unit_(options.radii.mean()) {
        radii_.setConstant(options.particles + options.voids, first_void_radius);
        radii_.head(structure_) = options.radii / unit_;
        solid_volume_ = 4 * std::numbers::pi / 3 * radii_.head(structure_).array().cube().sum();
        cell_ = Cell::periodic(Eigen::Vector3d::Constant(std::cbrt(solid_volume_ / options.volume_fraction)));
        last_void_radius_ = expected_void_radius();
    }

    VoidExpansion run() {
        dem::ParticleSystem system(cell_, start_positions(), radii_, skin);
        system.keep_near(near_skin);
        reject_dense_start(system);
        double growth = increment;
        while (true) {
            grow_voids(system, growth);
            settle(system);
            const StructureContacts contacts = measure(system, structure_, options_.contact_tolerance);
            note_ = "coordination " + short_text(contacts.coordination);
            const bool near_target =
                contacts.coordination > options_.target_coordination - trial_distance || contacts.overlap_rms > pressed_overlap;
            if (near_target && increments_ >= next_trial_) {
                VoidExpansion trial = describe(relax_without_voids(system));
                if (is_found(trial)) {
                    return trial;
                }
                const double missing = std::max(0.0, options_.target_coordination - trial.coordination);
                next_trial_ = increments_ + std::max<Index>(1, static_cast<Index>(missing / fastest_rise));
            }
            const bool crushed = contacts.overlap_rms > largest_overlap;
            if (crushed || solid_volume_ + void_volume() > largest_volume * cell_.volume()) {
                VoidExpansion last = describe(relax_without_voids(system));
                if (is_found(last)) {
                    return last;
                }
                throw OutOfReach(how_far(last, crushed ? "the overlap passes 9 % of the diameter" : "the voids fill the box"));
            }
            growth = near_target || contacts.overlap_rms > fine_overlap ? fine_increment : increment;
        }
    }

private:
    /// Uniform at random; then the structure particles are moved apart, with the voids absent.
    Eigen::Matrix3Xd start_positions() const {
        Eigen::Matrix3Xd positions(3, radii_.size());
        for (Index particle = 0; particle < radii_.size(); ++particle) {
            const auto number = static_cast<std::uint64_t>(particle);
            const Eigen::Vector3d place = random_uniform(options_.seed, RandomPurpose::initial_position, 0, number);
            positions.col(particle) = place.cwiseProduct(cell_.lengths());
        }
        dem::ParticleSystem structure(cell_, positions.leftCols(structure_), radii_.head(structure_), skin);
        dem::Fire fire(structure, laws, start_time_step, 2 * start_time_step);
        Index iterations = 0;
        while (fire.iterate() > start_force) {
            progress_.update("void expansion", 0.0, "moving the particles apart");
            if (++iterations > most_iterations) {
                throw OutOfReach("the void expansion cannot move " + std::to_string(structure_) +
                                 " particles apart at volume fraction " + to_text(options_.volume_fraction) +
                                 ": ask for a lower volume fraction");
            }
        }
        positions.leftCols(structure_) = structure.positions();
        return positions;
    }

    /// Growing voids only ever adds contacts.
    void reject_dense_start(dem::ParticleSystem& system) const {
        if (measure(system, structure_, options_.contact_tolerance).coordination < options_.target_coordination) {
            return;
        }
        const double coordination = coordination_of(relax_without_voids(system));
        if (coordination >= options_.target_coordination) {
            throw OutOfReach("the target coordination is " + to_text(options_.target_coordination) + ", but at volume fraction " +
                             to_text(options_.volume_fraction) + " the packing has " + short_text(coordination) +
                             " before any void has grown: ask for " +
                             (coordination < highest_target - 0.1 ? "a higher coordination or " : "") + "a lower volume fraction");
        }
    }

    void grow_voids(dem::ParticleSystem& system, double growth) {
        radii_.tail(options_.voids).array() += growth;
        system.set_radii(radii_);
        if (increments_ == 0 || void_radius() > 1) {
            system.set_masses(radii_.unaryExpr([](double radius) { return mass_of(radius); }));
        }
        ++increments_;
    }

    /// The more neighbours a sphere has room for, the stiffer it is held: large ones are heavier, for the sake of the time step.
    static double mass_of(double radius) { return std::max(1.0, (1 + radius) * (1 + radius) / 6); }

    /// A large void pushes more particles, and farther, than a small one.
    Index most_steps() const {
        const bool early = void_radius() < early_growth * last_void_radius_;
        return std::lround((early ? early_steps_per_increment : steps_per_increment) * std::clamp(last_void_radius_, 1.0, 3.0));
    }

    void settle(dem::ParticleSystem& system) {
        const Index most_steps = this->most_steps();
        for (Index count = 0; count < most_steps; ++count) {
            dem::step(system, laws, stepping);
            ++steps_;
            report();
            if (count % 10 == 9 && dem::rms_force(system, structure_) < settled_force) {
                return;
            }
        }
    }

    /// The trial on a copy: voids deleted, near pairs bonded, at rest.
    Packing relax_without_voids(const dem::ParticleSystem& system) const {
        const Packing structure{cell_, system.positions().leftCols(structure_), radii_.head(structure_)};
        dem::RelaxOptions relaxing;
        relaxing.normal_stiffness = 1;
        relaxing.tolerance = relaxed_force;
        relaxing.method = dem::RelaxMethod::damped;
        relaxing.damping = stepping.damping;
        relaxing.fire_below = contacts_force;
        relaxing.bond_on_touch = true;
        relaxing.max_iterations = most_iterations;
        const Progress inner([this](std::string_view, double, std::string_view) {
            report();
            return true;
        });
        const dem::Relaxation relaxed =
            dem::relax(structure, find_contacts(structure, options_.contact_tolerance), relaxing, inner);
        if (!relaxed.converged) {
            throw std::runtime_error("the void expansion could not relax the packing: after " + std::to_string(relaxed.iterations) +
                                     " iterations the rms force is still " + to_text(relaxed.rms_force) +
                                     " times the contact stiffness and the particle radius");
        }
        return relaxed.packing;
    }

    double coordination_of(const Packing& packing) const {
        return coordination_number(find_contacts(packing, options_.contact_tolerance));
    }

    double void_radius() const { return radii_[structure_]; }

    double void_volume() const {
        return 4 * std::numbers::pi / 3 * static_cast<double>(options_.voids) * std::pow(void_radius(), 3);
    }

    bool is_found(const VoidExpansion& trial) const {
        return trial.coordination >= options_.target_coordination && trial.overlap_rms < relaxed_overlap;
    }

    /// How far the packing comes, and what to ask for instead.
    std::string how_far(const VoidExpansion& last, const std::string& where) const {
        const bool overlaps = last.coordination >= options_.target_coordination;
        return "the void expansion cannot reach a coordination of " + to_text(options_.target_coordination) + " with " +
               std::to_string(options_.voids) + " voids among " + std::to_string(structure_) + " particles at volume fraction " +
               to_text(options_.volume_fraction) + ": the packing comes to " + short_text(last.coordination) + " where " + where +
               (overlaps ? ", but without the voids its particles still overlap by " + short_text(100 * last.overlap_rms) +
                               " %, where " + short_text(100 * relaxed_overlap) + " % is allowed; ask for a lower coordination"
                         : "; ask for a coordination below that") +
               ", a higher volume fraction or other numbers of particles and voids";
    }

    /// The result, in metres.
    VoidExpansion describe(const Packing& relaxed) const {
        VoidExpansion result;
        result.packing.cell = Cell::periodic(unit_ * cell_.lengths());
        result.packing.radii = options_.radii;
        result.packing.positions = unit_ * relaxed.positions;
        result.contacts = find_contacts(result.packing, options_.contact_tolerance);
        result.coordination = coordination_number(result.contacts);
        const Index contacts = result.contacts.size();
        Eigen::ArrayXd overlap(contacts);
        for (Index contact = 0; contact < contacts; ++contact) {
            const auto ends = result.contacts.ends.col(contact);
            const double reach = options_.radii[ends[0]] + options_.radii[ends[1]];
            overlap[contact] = std::max(0.0, reach - result.contacts.branch.col(contact).norm()) / (2 * unit_);
        }
        result.overlap_rms = contacts > 0 ? std::sqrt(overlap.square().mean()) : 0.0;
        result.overlap_max = contacts > 0 ? overlap.maxCoeff() : 0.0;
        result.void_radius = unit_ * void_radius();
        result.increments = increments_;
        result.steps = steps_;
        return result;
    }

    /// The volume that spheres take at the end rises from about 0.64 to 0.83 with the number of voids
    /// (N_V/N = 1/8 to 2).
    double expected_void_radius() const {
        const double ratio = static_cast<double>(options_.voids) / static_cast<double>(structure_);
        const double filled = std::min(0.63 + 0.09 * ratio, 0.85) * cell_.volume() - solid_volume_;
        const double cubed = std::max(filled, 0.0) / (4 * std::numbers::pi / 3 * static_cast<double>(options_.voids));
        return std::max(std::cbrt(cubed), first_void_radius + increment);
    }

    void report() const {
        const double grown = (void_radius() - first_void_radius) / (last_void_radius_ - first_void_radius);
        progress_.update("void expansion", std::clamp(grown, 0.0, 0.99), note_);
    }

    const VoidExpansionOptions& options_;
    const Progress& progress_;
    Index structure_;  ///< number of structure particles; the voids follow them
    double unit_;      ///< mean radius [m]
    Cell cell_;
    Eigen::VectorXd radii_;
    double solid_volume_ = 0;
    double last_void_radius_ = 0;
    Index increments_ = 0;
    Index next_trial_ = 0;  ///< no trial before this increment
    Index steps_ = 0;
    std::string note_ = "placing particles";
};

}  // namespace

void check(const VoidExpansionOptions& options) {
    require(options.particles >= 3,
            "the number of particles is " + std::to_string(options.particles) + ", but the void expansion needs at least 3");
    require(options.voids >= 1, "the number of voids is " + std::to_string(options.voids) +
                                    ", but the void expansion needs at least 1: without voids there is nothing to expand");
    require(options.particles + options.voids <= 100000000, "the void expansion can hold at most 100 million particles and voids");
    require_between(options.volume_fraction, 0, 0.64, "the volume fraction");
    require_between(options.target_coordination, 0, highest_target, "the target coordination");
    require_between(options.contact_tolerance, 0, 0.1, "the contact tolerance");
    require(options.radii.size() == options.particles, "the void expansion has " + std::to_string(options.particles) +
                                                           " particles, but " + std::to_string(options.radii.size()) +
                                                           " radii were given");
    for (Index particle = 0; particle < options.particles; ++particle) {
        require_positive(options.radii[particle], "the radius of particle " + std::to_string(particle), "m");
    }
}

VoidExpansion expand_voids(const VoidExpansionOptions& options, const Progress& progress) {
    check(options);
    Expansion expansion(options, progress);
    return expansion.run();
}

}  // namespace coagula::generators
