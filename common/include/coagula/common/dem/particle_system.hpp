// SPDX-License-Identifier: GPL-3.0-or-later
// Moving spheres with their neighbour list, laid out for speed: the state behind the explicit stepper and the minimiser.
#pragma once

#include <coagula/common/cell.hpp>
#include <coagula/common/contact_memory.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/dem/bond_list.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace coagula::dem {

/// Three components and a companion number, padded so that two vector registers hold them.
using Quad = Eigen::Vector4d;

/// A contact of the general law (general_forces.hpp), bonded or touching, between two slots.
struct SlotContact {
    SlotPair ends;
    ContactMemory memory;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the first at the last evaluation [N]
};

/// A film of solvent that two particles squeeze.
struct SlotFilm {
    SlotPair ends;
    Eigen::Vector3d branch;  ///< [m]
    Eigen::Vector3d force;   ///< on the first [N]
};

/// A part of space: the particles it owns, copies of the particles of other parts (ghosts) that they may touch, and the pairs.
/// Each pair and bond belongs to one chunk; its first slot is owned by the chunk. The number of chunks depends on the number of
/// particles only, so that sums over chunks in order do not depend on the number of threads.
struct Chunk {
    std::int32_t begin = 0;    ///< own slots are [begin, own_end)
    std::int32_t own_end = 0;  ///< ghosts are [own_end, end)
    std::int32_t end = 0;
    std::vector<SlotPair> pairs;  ///< unbonded pairs nearer than r_i + r_j + skin when the list was made
    BondList bonds;
    detail::BondExtremes extremes;  ///< of the bonds in the last evaluation
    std::vector<SlotContact> contacts;
    std::vector<SlotFilm> films;                       ///< scratch: those of the last evaluation
    double dissipated = 0;                             ///< by general contacts in the last evaluation [J]
    Eigen::Matrix3d virial = Eigen::Matrix3d::Zero();  ///< of general contacts: sum of force on first times branch [J]
    std::size_t handed_begin = 0;  ///< forces from ghosts for this chunk are entries [handed_begin, handed_end) of Slots::handed
    std::size_t handed_end = 0;
    std::vector<SlotPair> near;              ///< those of `pairs` that may come to overlap soon; see ParticleSystem::keep_near
    std::vector<std::int32_t> near_numbers;  ///< where they stand in `pairs`
    bool near_stale = true;                  ///< whether `near` must be chosen anew before it is used
    double near_path = 0;                    ///< `path` when it was last chosen [m]
    std::vector<std::int32_t> touching;      ///< scratch: pairs that overlap
    double path = 0;                         ///< no particle of the chunk is farther from where it was when the list was made [m]
};

/// Per-slot arrays. A slot is a particle (own) or a periodic image or copy of one (ghost); ghosts are refreshed before each force
/// evaluation, and the forces on them are handed to their particle afterwards.
struct Slots {
    std::vector<Quad> position;           ///< x, y, z, radius [m]
    std::vector<Quad> velocity;           ///< [m/s]
    std::vector<Quad> force;              ///< [N]
    std::vector<Quad> spin;               ///< angular velocity [rad/s]
    std::vector<Quad> turn;               ///< rotation since the last force evaluation [rad]
    std::vector<Quad> moment;             ///< [N m]
    std::vector<Quad> reference;          ///< position when the list was made [m]
    std::vector<double> inverse_mass;     ///< [1/kg]
    std::vector<double> inverse_inertia;  ///< [1/(kg m^2)]
    std::vector<std::int32_t> particle;   ///< number of the particle in the caller's order
    std::vector<std::int32_t> source;     ///< own slot that a ghost copies; an own slot names itself
    std::vector<Eigen::Vector3i> images;  ///< periods that a ghost is away from its source
    std::vector<Quad> shift;              ///< the same as a length [m]
    std::vector<SlotPair> handed;         ///< own slot and ghost of it, sorted: whose forces go where
};

/// A bond, or a contact of the general law, in the caller's particle numbers.
struct Bond {
    std::int32_t first = 0;
    std::int32_t second = 0;
    Eigen::Vector3i images = Eigen::Vector3i::Zero();  ///< it reaches the image of `second` that is so many periods away
    ContactMemory memory;                              ///< simple bonds have rest length, branch and shear only
};

/// Simple shear of the periodic cell: the image one period along `normal` lies `strain` periods along `direction` farther.
struct CellShear {
    int direction = 0;
    int normal = 2;
    double strain = 0;

    /// Where shear takes a point of the unsheared cell, and back.
    Eigen::Vector3d apply(Eigen::Vector3d point) const {
        point[direction] += strain * point[normal];
        return point;
    }
    Eigen::Vector3d undo(Eigen::Vector3d point) const {
        point[direction] -= strain * point[normal];
        return point;
    }
};

/// All that moves and all that is remembered, in the caller's order: a system made of it goes on to the same bits.
struct ParticleState {
    std::vector<Quad> position, velocity, spin, turn, force, moment;
    std::vector<double> inverse_mass, inverse_inertia;
    std::vector<Bond> bonds;
    CellShear shear;
};

struct ChunkPlan;

/// Spheres that move. Input and output are in the caller's order; inside, particles are sorted in space and grouped in chunks.
class ParticleSystem {
public:
    /// Masses are 1 until set, inertias those of solid spheres, velocities zero.
    /// @param skin the neighbour list holds pairs nearer than r_i + r_j + skin [m], > 0; it is made anew as soon as an unlisted
    /// pair
    ///        could touch.
    ParticleSystem(const Cell& cell, const Eigen::Matrix3Xd& positions, const Eigen::VectorXd& radii, double skin);

    Index size() const { return static_cast<Index>(radii_.size()); }
    const Cell& cell() const { return cell_; }

    /// [kg]; inertias become those of solid spheres, 2/5 m r^2.
    void set_masses(const Eigen::VectorXd& masses);
    /// [m]; masses and inertias stay.
    void set_radii(const Eigen::VectorXd& radii);
    /// 3 x N [m/s].
    void set_velocities(const Eigen::Matrix3Xd& velocities);
    /// Angular velocities, 3 x N [rad/s].
    void set_spins(const Eigen::Matrix3Xd& spins);
    /// Bonds pairs (each once, not yet bonded); rest length r_i + r_j. Branches name the image meant and are measured anew.
    void add_bonds(const ContactNetwork& pairs);
    /// The same with a memory for each, made by `make(branch, first_radius, second_radius)`.
    void add_bonds(const ContactNetwork& pairs, const std::function<ContactMemory(const Eigen::Vector3d&, double, double)>& make);
    /// Takes away the simple bonds for which `breaks(bond)` holds and returns them; their particles become ordinary pairs. Nothing
    /// else changes, not even the order in which forces are summed. Branches and shear are those of the last force evaluation by a
    /// law with shear; see largest_bond_loads() for whether any bond need be visited.
    std::vector<Bond> remove_bonds(const std::function<bool(const Bond&)>& breaks);
    /// Largest stretch and squared shear displacement of a simple bond in the last force evaluation; those made on touch in it are
    /// left out.
    detail::BondExtremes largest_bond_loads() const;
    /// Bonds become contacts of the general law (general_forces.hpp), or simple bonds again.
    void use_general_contacts(bool general);

    /// These particles are moved by nobody but set_velocity: their mass is infinite.
    void hold(const std::vector<Index>& particles);
    /// Gives these particles one velocity [m/s].
    void set_velocity(const std::vector<Index>& particles, const Eigen::Vector3d& velocity);

    /// Strains the periodic cell and all particles in it affinely by x_direction += increment x_normal; contacts will see it as
    /// motion. One pair of axes per system, the cell starts unsheared. Throws std::invalid_argument for an open cell or other axes.
    void shear(int direction, int normal, double increment);
    /// Shear of the cell now; whole periods of strain are left out, because the lattice repeats.
    const CellShear& cell_shear() const { return shear_; }

    /// Everything that a run needs to go on.
    ParticleState state() const;
    /// Goes on from a state of a system of the same particles; the neighbour list is made anew. Throws std::invalid_argument when
    /// there are not as many.
    void restore(ParticleState state);

    Eigen::Matrix3Xd positions() const;   ///< wrapped into a periodic cell [m]
    Eigen::Matrix3Xd velocities() const;  ///< [m/s]
    Eigen::Matrix3Xd spins() const;       ///< [rad/s]
    Eigen::Matrix3Xd forces() const;      ///< of the last evaluation [N]
    Eigen::Matrix3Xd moments() const;     ///< of the last evaluation [N m]
    /// Sum of the forces on these particles at the last evaluation [N].
    Eigen::Vector3d total_force(const std::vector<Index>& particles) const;
    const Eigen::VectorXd& radii() const { return radii_; }
    Packing packing() const { return {cell_, positions(), radii_}; }
    std::vector<Bond> bonds() const;
    /// The bonds with their present branches, sorted as find_contacts does.
    ContactNetwork bond_network() const;

    /// Makes the neighbour list anew if it may lack a pair nearer than r_i + r_j + margin, that is if
    /// 2 (largest displacement + growth of a radius) + margin > skin; shear of the cell brings pairs closer, too.
    /// @param margin [m], < skin.
    void refresh(double margin = 0) {
        double path = 0;
        for (const Chunk& chunk : chunks_) {
            path = std::max(path, chunk.path);
        }
        if (!(2 * (path + growth_) + approach_ + listed_gap_ + margin <= skin_)) {
            refresh_carefully(margin);
        }
        if (near_skin_ > 0) {
            refresh_near();
        }
    }
    /// Forces are looked for only among the listed pairs nearer than r_i + r_j + near_skin [m], which are chosen anew whenever
    /// another could touch. That pays where the skin is large. The forces stay the same to the bit.
    void keep_near(double near_skin) { near_skin_ = near_skin; }
    double near_skin() const { return near_skin_; }
    /// The list must always hold all pairs nearer than r_i + r_j + gap [m], < skin.
    void keep_listed(double gap);
    /// How often the list has been made.
    Index list_builds() const { return list_builds_; }

    /// For the loops over pairs and particles (forces.hpp, stepper.hpp, minimise.hpp).
    Slots& slots() { return slots_; }
    const Slots& slots() const { return slots_; }
    std::vector<Chunk>& chunks() { return chunks_; }
    const std::vector<Chunk>& chunks() const { return chunks_; }

private:
    void refresh_carefully(double margin);
    void refresh_near();
    void forget_near();
    void reduce_shear(ParticleState& state) const;
    void wrap(ParticleState& state) const;
    void rebuild(ParticleState state);
    std::vector<ChunkPlan> plan(const ParticleState& state, std::vector<std::int32_t>& order) const;
    Eigen::Vector3d image_shift(const Eigen::Vector3i& images) const;
    Bond in_callers_numbers(const SlotPair& ends) const;
    Bond in_callers_numbers(const SlotBond& simple) const;
    void lay_out_chunks(const std::vector<ChunkPlan>& plans);
    void fill_slot(std::int32_t own_slot, std::int32_t particle, const ParticleState& state);
    void fill_chunk(Chunk& chunk, const ChunkPlan& plan, const std::vector<std::int32_t>& order, const std::vector<Bond>& bonds);
    Eigen::Matrix3Xd in_callers_order(const std::vector<Quad>& values) const;
    void set_in_slots(std::vector<Quad>& values, const Eigen::Matrix3Xd& given, const char* name);

    Cell cell_;
    double skin_;
    Eigen::VectorXd radii_;       ///< caller's order [m]
    Eigen::VectorXd list_radii_;  ///< when the list was made [m]
    double growth_ = 0;           ///< of a radius since then, the largest [m]
    CellShear shear_;
    double list_strain_ = 0;  ///< of the cell when the list was made
    double approach_ = 0;     ///< that shear since then may have brought unlisted pairs closer, at most [m]
    double listed_gap_ = 0;
    double near_skin_ = 0;      ///< 0: no near pairs are kept [m]
    double near_growth_ = 0;    ///< of a radius since the near pairs were chosen, at most [m]
    double near_approach_ = 0;  ///< that shear since then may have brought other pairs closer, at most [m]
    bool general_ = false;
    Index list_builds_ = 0;
    Slots slots_;
    std::vector<Chunk> chunks_;
    std::vector<std::int32_t> slot_of_;  ///< own slot of each particle
};

}  // namespace coagula::dem
