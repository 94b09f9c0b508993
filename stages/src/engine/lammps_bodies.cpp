// SPDX-License-Identifier: GPL-3.0-or-later
#include "lammps_bodies.hpp"

#include "lammps_process.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/readable.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace coagula::stages {

namespace {

constexpr double moment_arm = 1;       // of the springs that resist moments, in mean radii
constexpr double least_mass = 0.05;    // of a centre, per contact: where k_s = k_n it bears no spring
constexpr double beyond_bonds = 1.05;  // reach of what an MPI process knows of its neighbours, over that of a bond

/// Springs of length zero at one contact, all of one stiffness.
struct PointSprings {
    double stiffness = 0;
    std::vector<Eigen::Vector3d> places;  ///< from the contact
};

constexpr std::size_t kinds_of_points = 3;

/// The springs of a contact: one at the contact point, two along its normal, and four across it.
std::array<PointSprings, kinds_of_points> point_springs(const ContactRatios& ratios, const Eigen::Vector3d& normal) {
    const Eigen::Vector3d across = moment_arm * normal.unitOrthogonal();
    const Eigen::Vector3d other = normal.cross(across);
    const double across_stiffness = 0.25 * ratios.twisting / (moment_arm * moment_arm);
    const double along_stiffness = 0.5 * ratios.bending / (moment_arm * moment_arm) - across_stiffness;
    return {{{ratios.shear - 2 * along_stiffness - 4 * across_stiffness, {Eigen::Vector3d::Zero()}},
             {along_stiffness, {moment_arm * normal, -moment_arm * normal}},
             {across_stiffness, {across, -across, other, -other}}}};
}

/// The edges of the cell in LAMMPS's axes are the upper triangular factor.
struct Frame {
    Eigen::Matrix3d axes;
    Eigen::Matrix3d edges;
};

Frame frame_of(Eigen::Matrix3d edges) {
    if (edges.determinant() < 0) {
        edges.col(2) *= -1;  // the same lattice
    }
    const Eigen::HouseholderQR<Eigen::Matrix3d> factors(edges);
    Frame frame{factors.householderQ(), factors.matrixQR().triangularView<Eigen::Upper>()};
    const Eigen::Vector3d signs = frame.edges.diagonal().cwiseSign();
    frame.axes = frame.axes * signs.asDiagonal();
    frame.edges = signs.asDiagonal() * frame.edges;
    return frame;
}

class BodyText {
public:
    BodyText(const Packing& packing, const ContactNetwork& bonds, const ContactRatios& ratios, const Eigen::Matrix3d& deformation)
        : packing_(packing),
          bonds_(bonds),
          ratios_(ratios),
          length_(mean_radius(packing)),
          deformation_(deformation),
          frame_(frame_of(deformation * packing.cell.reduced().edges() / length_)),
          counts_(contact_counts(bonds)),
          most_contacts_(bonds.size() > 0 ? counts_.maxCoeff() : 0) {}

    LammpsBodies write() {
        append_centres();
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            append_contact(bond);
        }
        return {.data = text(), .masses = masses(), .turn = has_points_, .reach = reach_, .axes = frame_.axes};
    }

private:
    void append_centres() {
        number_.assign(static_cast<std::size_t>(packing_.size()), 0);
        for (Index particle = 0; particle < packing_.size(); ++particle) {
            if (counts_[particle] > 0) {
                number_[static_cast<std::size_t>(particle)] = append_atom(particle, counts_[particle], centre(particle));
            }
        }
    }

    void append_contact(Index bond) {
        const Index first = bonds_.ends(0, bond);
        const Index second = bonds_.ends(1, bond);
        const Eigen::Vector3d branch = bonds_.branch.col(bond) / length_;
        const double distance = branch.norm();
        reach_ = std::max(reach_, distance);
        coefficients_ += bond_coefficients(bond_types_ + 1, 1 - ratios_.shear, distance);
        append_bond(++bond_types_, number_[static_cast<std::size_t>(first)], number_[static_cast<std::size_t>(second)]);
        const double share = packing_.radii[first] / (packing_.radii[first] + packing_.radii[second]);
        const auto springs = point_springs(ratios_, branch / distance);
        for (std::size_t kind = 0; kind < springs.size(); ++kind) {
            if (springs[kind].stiffness == 0) {
                continue;
            }
            has_points_ = true;
            const int type = most_contacts_ + 1 + static_cast<int>(kind);
            for (const Eigen::Vector3d& place : springs[kind].places) {
                const Index one = append_atom(first, type, centre(first) + turned(share * branch + place));
                const Index other = append_atom(second, type, centre(second) + turned((share - 1) * branch + place));
                append_bond(static_cast<Index>(kind) + 1, one, other);
                reach_ = std::max(reach_, 2 * (std::max(share, 1 - share) * distance + place.norm()));
            }
        }
    }

    Eigen::Vector3d turned(const Eigen::Vector3d& vector) const { return frame_.axes.transpose() * vector; }
    Eigen::Vector3d centre(Index particle) const {
        return turned(deformation_ * (packing_.positions.col(particle) - packing_.cell.origin()) / length_);
    }

    /// Places are given inside the cell, with the cell's image in which they are: by these LAMMPS puts bodies together.
    Index append_atom(Index body, int type, const Eigen::Vector3d& at) {
        const Eigen::Vector3d image = (frame_.edges.inverse() * at).array().floor();
        const Eigen::Vector3d place = at - frame_.edges * image;
        atoms_ += std::to_string(++atom_count_) + ' ' + std::to_string(body + 1) + ' ' + std::to_string(type);
        for (const double coordinate : place) {
            atoms_ += ' ' + to_text(coordinate);
        }
        for (const double cells : image) {
            atoms_ += ' ' + std::to_string(static_cast<std::int64_t>(cells));
        }
        atoms_ += '\n';
        return atom_count_;
    }

    void append_bond(Index type, Index one, Index other) {
        bond_lines_ += std::to_string(++bond_count_) + ' ' + std::to_string(type) + ' ' + std::to_string(one) + ' ' +
                       std::to_string(other) + '\n';
    }

    /// LAMMPS's energy is K (r - r0)^2.
    static std::string bond_coefficients(Index type, double stiffness, double rest) {
        return std::to_string(type) + ' ' + to_text(0.5 * stiffness) + ' ' + to_text(rest) + '\n';
    }

    std::vector<double> masses() const {
        std::vector<double> masses;
        const double each = std::max(std::abs(1 - ratios_.shear), least_mass);
        for (int contacts = 1; contacts <= most_contacts_; ++contacts) {
            masses.push_back(contacts * each);
        }
        for (const PointSprings& springs : point_springs(ratios_, Eigen::Vector3d::UnitX())) {
            masses.push_back(springs.stiffness == 0 ? least_mass : std::abs(springs.stiffness));
        }
        return masses;
    }

    std::string text() const {
        const std::vector<double> of_types = masses();
        std::string all = "particles as rigid bodies, lengths in radii\n\n" + std::to_string(atom_count_) + " atoms\n" +
                          std::to_string(of_types.size()) + " atom types\n" + std::to_string(bond_count_) + " bonds\n" +
                          std::to_string(bond_types_) + " bond types\n\n";
        const std::string axes = "xyz";
        for (int axis = 0; axis < 3; ++axis) {
            const std::string name(1, axes[static_cast<std::size_t>(axis)]);
            all += "0 " + to_text(frame_.edges(axis, axis)) + ' ' + name + "lo " + name + "hi\n";
        }
        all += to_text(frame_.edges(0, 1)) + ' ' + to_text(frame_.edges(0, 2)) + ' ' + to_text(frame_.edges(1, 2)) +
               " xy xz yz\n\nMasses\n\n";
        for (std::size_t type = 0; type < of_types.size(); ++type) {
            all += std::to_string(type + 1) + ' ' + to_text(of_types[type]) + '\n';
        }
        all += "\nBond Coeffs\n\n";
        const auto springs = point_springs(ratios_, Eigen::Vector3d::UnitX());
        for (std::size_t kind = 0; kind < springs.size(); ++kind) {
            all += bond_coefficients(static_cast<Index>(kind) + 1, springs[kind].stiffness, 0);
        }
        return all + coefficients_ + "\nAtoms # bond\n\n" + atoms_ + "\nBonds\n\n" + bond_lines_;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    const ContactRatios& ratios_;
    double length_;
    Eigen::Matrix3d deformation_;
    Frame frame_;
    Eigen::VectorXi counts_;
    int most_contacts_;
    std::vector<Index> number_;  ///< of the atom at the centre of each particle
    std::string atoms_;
    std::string bond_lines_;
    std::string coefficients_;
    Index atom_count_ = 0;
    Index bond_count_ = 0;
    Index bond_types_ = kinds_of_points;
    bool has_points_ = false;
    double reach_ = 0;
};

}  // namespace

LammpsBodies lammps_bodies(const Packing& packing, const ContactNetwork& bonds, const ContactRatios& ratios,
                           const Eigen::Matrix3d& deformation) {
    return BodyText(packing, bonds, ratios, deformation).write();
}

std::string lammps_bodies_setup(const LammpsBodies& bodies, const std::filesystem::path& folder) {
    return "clear\n"
           "units lj\n"
           "atom_style bond\n"
           "box tilt large\n"
           "newton on\n"
           "bond_style harmonic\n"
           "comm_modify cutoff " +
           to_text(beyond_bonds * bodies.reach) +
           "\n"
           "read_data " +
           quoted(folder / "network.data") +
           "\n"
           "neighbor 0.1 bin\n"
           // Nobody moves by more than the strain.
           "neigh_modify delay 0 every 1000000000 check no\n" +
           std::string(bodies.turn ? "fix move all rigid/small molecule\n" : "fix move all nve\n") +
           "compute stress all pressure NULL virial\n"
           "thermo_style custom step pe c_stress[1] c_stress[2] c_stress[3] c_stress[4] c_stress[5] c_stress[6]\n"
           "thermo_modify norm no\n"
           "thermo 1000000000\n"
           "timestep " +
           to_text(lammps_settling_step) + "\n";
}

std::string lammps_settle(const LammpsBodies& bodies, double rate, std::int64_t steps, const std::filesystem::path& file) {
    std::string commands = "fix drag all viscous " + to_text(rate);
    for (std::size_t type = 0; type < bodies.masses.size(); ++type) {
        commands += " scale " + std::to_string(type + 1) + ' ' + to_text(bodies.masses[type]);
    }
    const std::filesystem::path part = file.string() + ".part";
    commands += "\nrun " + std::to_string(steps) + " post no\nprint \"$(pe:%.17g)";
    for (int component = 1; component <= 6; ++component) {
        commands += " $(c_stress[" + std::to_string(component) + "]:%.17g)";
    }
    return commands + "\" file " + quoted(part) + " screen no\nshell mv " + quoted(part) + ' ' + quoted(file) + "\n";
}

LammpsRest read_lammps_rest(const std::filesystem::path& file) {
    std::ifstream stream(file);
    LammpsRest rest;
    Eigen::Matrix<double, 6, 1> pressure;  // xx yy zz xy xz yz
    stream >> rest.energy;
    for (double& component : pressure) {
        stream >> component;
    }
    if (!stream || !std::isfinite(rest.energy) || !pressure.allFinite()) {
        throw std::runtime_error("LAMMPS failed: its forces are no numbers");
    }
    rest.stress << pressure[0], pressure[3], pressure[4],  //
        pressure[3], pressure[1], pressure[5],             //
        pressure[4], pressure[5], pressure[2];
    rest.stress *= -1;
    return rest;
}

}  // namespace coagula::stages
