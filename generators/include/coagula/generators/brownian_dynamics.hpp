// SPDX-License-Identifier: GPL-3.0-or-later
// Brownian dynamics of spheres with pair forces: the coagulation of a suspension.
// Overdamped motion without hydrodynamic interactions: dx = mobility F dt + sqrt(2 kB T mobility) dW, mobility 1/(6 pi viscosity
// R).
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/common/random.hpp>
#include <coagula/generators/pair_potential.hpp>
#include <coagula/generators/shear_flow.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace coagula::generators {

enum class Integrator {
    stabilised,  ///< after SK-ROCK (Abdulle, Almuslimani, Vilmart 2018) with as many stages as the contacts need, and its
                 ///< postprocessor
    euler,       ///< Euler-Maruyama
};

/// Share of the free diffusion that particles keep on short times among others: (1 - 1.56 phi)(1 - 0.27 phi), a fit to hard spheres
/// with hydrodynamic interactions (Lionberger and Russel, J. Rheol. 38 (1994) 1885). Up to phi = 0.5 it is within 7 % of
/// 1 - 1.8315 phi (1 + 0.1195 phi - 0.70 phi^2) (Heinen, Banchio, Naegele, J. Chem. Phys. 135 (2011) 154504).
/// @param volume_fraction phi, 0 <= phi < 0.64, where it vanishes.
double mean_field_slowing(double volume_fraction);

/// What contacts oppose to sliding and rolling; nothing unless given. With any of it particles turn and have rotational Brownian
/// motion, mobility 1/(8 pi viscosity R^3). A contact lasts while the gap is below PairPotential::cut_gap; the limits count against
/// its elastic normal force, stiffness (cut gap - gap), which is the attraction and the load together. The elastic displacements
/// follow the motion of the contact point (Cundall and Strack, Geotechnique 29 (1979) 47; Luding, Granular Matter 10 (2008) 235).
/// For two spheres of mean radius; others scale as in simulate_brownian. Twisting is free.
struct ContactResistance {
    double tangential_stiffness = unset;  ///< [N/m]; sliding is free if unset
    double friction = unset;  ///< a contact slips when its tangential force exceeds this times the normal one; never if unset
    double rolling_stiffness = unset;  ///< force per rolling displacement at the reduced radius [N/m]; rolling is free if unset
    double rolling_friction = unset;   ///< the same limit of the rolling force; none if unset
};

/// Weight along -z, between a floor and a ceiling. The packing is cut open at the bottom of its box, which grows by a largest
/// radius below and above, where elastic walls of the stiffness of a contact are, and by an empty layer beyond the range of the
/// forces, so that particles at the floor and at the ceiling do not meet.
struct Sedimentation {
    double gravity = unset;             ///< [m/s^2], > 0; none if unset
    double density_difference = unset;  ///< of particles and liquid [kg/m^3]; below 0 particles rise
};

/// How a run ends by itself.
enum class PlateauOf { nothing, coordination, mean_gap };

/// What moves the particles. SI units.
struct BrownianOptions {
    double temperature = 293;  ///< [K]
    double viscosity = 1e-3;   ///< of the liquid [Pa s]
    double slowing = 1;        ///< share of the free diffusion that hydrodynamics leave on average, 0 < slowing <= 1
    ContactResistance resistance;
    Sedimentation sedimentation;
    ShearFlow flow;             ///< not with sedimentation, nor with snapshots: the box of a file does not change
    double cutoff_gap = unset;  ///< beyond it no force [m]; one mean radius if unset
    Integrator integrator = Integrator::stabilised;
    double time_step = unset;                     ///< [s]; chosen by choose_time_step if unset
    double stop_time = unset;                     ///< the run ends then [s]
    double stop_coordination = unset;             ///< or as soon as the mean number of contacts reaches this
    PlateauOf stop_plateau = PlateauOf::nothing;  ///< or as soon as this hardly changes any more
    /// Its means over the two halves of the last `plateau_time` differ by less than `plateau_change` of the later. Counted only
    /// while half of the particles or more hang together.
    double plateau_time = unset;         ///< [s]; a tenth of R^2/D if unset
    double plateau_change = 0.01;        ///< > 0
    double contact_tolerance = 0.01;     ///< pairs nearer than (1 + tolerance) (r_i + r_j) count as contacts
    double sample_interval = unset;      ///< of the time series [s]; a two-hundredth of the stop time, or 5e-4 R^2/D, if unset
    std::vector<double> snapshot_times;  ///< when positions are kept, besides the end [s]
    std::uint64_t seed = 1;
    RandomPurpose noise = RandomPurpose::brownian_force;  ///< another for a run that comes before, so that none is repeated
};

/// The time step of a run and why.
struct TimeStep {
    double time_step = unset;        ///< [s]
    int stages = 1;                  ///< force evaluations per step
    std::int64_t far_interval = 1;   ///< the smooth far forces are evaluated once in so many steps
    double stability_bound = unset;  ///< longest stable time step of the integrator [s]
    double accuracy_bound = unset;   ///< longest that passes the barrier, or the rim of a well, at the right rate to 5 % [s]
    double diffusion_time = unset;   ///< tau = R^2/D of a particle of mean radius [s]
    std::string reason;              ///< what sets the time step
};

/// @param closest_gap smallest gap at the start [m]: inside the barrier, or where thermal motion passes it, contacts count.
/// Throws std::invalid_argument for impossible options, among them a time step above the stability bound.
TimeStep choose_time_step(const PairPotential& potential, double mean_radius, double closest_gap, const BrownianOptions& options);

/// Values at the times of the samples; all of one length.
struct BrownianSeries {
    std::vector<double> time;               ///< [s]
    std::vector<double> coordination;       ///< mean number of contacts
    std::vector<double> energy;             ///< of all pairs, without sliding and rolling [J]
    std::vector<double> sliding_energy;     ///< elastic, of the tangential displacements [J]
    std::vector<double> rolling_energy;     ///< elastic, of the rolling displacements [J]
    std::vector<double> mean_gap;           ///< of the contacts [m]; 0 without contacts
    std::vector<std::int64_t> clusters;     ///< particles joined by contacts, single ones included
    std::vector<std::int64_t> largest;      ///< particles in the largest cluster
    std::vector<std::int64_t> percolating;  ///< axes along which contacts reach around the box, 0 to 3
    std::vector<std::int64_t> formed;       ///< contacts that are new since the sample before
    std::vector<std::int64_t> broken;       ///< contacts that are gone since the sample before
    StressSeries stress;                    ///< empty without a flow
};

/// Positions at a time.
struct Snapshot {
    double time = unset;         ///< [s]
    Eigen::Matrix3Xd positions;  ///< inside the box [m]
};

/// What contacts that resist sliding or rolling remember, one column each, sorted by their particles.
struct ContactMemories {
    Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic> ends;  ///< lower particle first
    Eigen::Matrix3Xd sliding;                             ///< [mean radii]
    Eigen::Matrix3Xd rolling;                             ///< [rad]
};

/// All that a run needs to go on to the same bits. Positions in units of the mean radius.
struct BrownianCheckpoint {
    std::int64_t step = 0;
    Eigen::Matrix3Xd positions;
    Eigen::Matrix3Xd list_reference;
    Eigen::Matrix3Xd near_reference;
    double list_strain = 0;  ///< of the flow when the references were taken
    double near_strain = 0;
    Eigen::Matrix3Xd far_forces;
    StressSum stress;                                         ///< since the last sample
    Eigen::Matrix3Xd rotations;                               ///< sums of rotation vectors; empty where particles do not turn
    ContactMemories memories;                                 ///< empty where nothing resists
    Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic> contacts;  ///< of the last sample
    BrownianSeries series;
    std::vector<Snapshot> snapshots;
};

/// How a long run is watched and resumed.
struct BrownianControl {
    std::function<bool()> checkpoint_due;                          ///< asked now and then; empty: never
    std::function<void(const BrownianCheckpoint&)> on_checkpoint;  ///< also called when the run is cancelled
    bool at_end = false;                                           ///< one where the run ends, or just before its stop time
    const BrownianCheckpoint* resume = nullptr;                    ///< go on from here; the options must be the same
};

struct BrownianRun {
    Packing packing;          ///< at the end
    ContactNetwork contacts;  ///< pairs within the contact tolerance
    double time = unset;      ///< simulated [s]
    double coordination = unset;
    std::int64_t steps = 0;
    std::string ended_by;  ///< what ended the run: "time", "coordination" or "plateau"
    TimeStep time_step;
    BrownianSeries series;
    std::vector<Snapshot> snapshots;  ///< before the end, in the order of time
};

/// Moves the particles of a packing in a periodic box, which is rectangular, or leans as a flow makes it lean: the third edge along
/// x. The potential is that of two particles of mean radius; for others it is
/// scaled with 2 R1 R2/(R1 + R2) over the mean radius at equal gap (Derjaguin's approximation). The result depends on packing and
/// options alone, not on the number of threads, nor on whether it was interrupted and resumed. Throws std::invalid_argument for
/// impossible options and InputError for particles that overlap by more than 5 % at the start.
BrownianRun simulate_brownian(const Packing& start, const PairPotential& potential, const BrownianOptions& options,
                              const Progress& progress = {}, const BrownianControl& control = {});

/// How a suspension is prepared.
struct SuspensionOptions {
    double volume_fraction = unset;  ///< 0 < phi < 0.55
    Eigen::VectorXd radii;           ///< N radii [m]
    std::uint64_t seed = 1;
};

/// Particles placed at random in a periodic cube and moved apart to gaps of about a fifth of a radius, less where it is crowded.
Packing place_suspension(const SuspensionOptions& options, const Progress& progress = {});

}  // namespace coagula::generators
