// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/hertz_curve.hpp>

#include <coagula/common/general_contact.hpp>
#include <coagula/mechanics/linear.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace coagula::mechanics {

namespace {

constexpr double settled_modulus = 1e-3;  ///< change of the modulus in an iteration, over it
constexpr int most_secant_iterations = 20;
constexpr double least_secant = 0.05;  ///< of a contact that is sheared back, over its tangent
constexpr double share_of_new = 0.7;   // in the overlaps of the next iteration: stiffer bonds stretch less, so that they overshoot

/// ShearPlane a-b and its place among the strains (Voigt).
struct ShearPlane {
    int a;
    int b;
    int strain;
};
constexpr std::array<ShearPlane, 3> shear_planes{{{1, 2, 3}, {0, 2, 4}, {0, 1, 5}}};

class HertzNetwork {
public:
    HertzNetwork(const Packing& packing, const ContactNetwork& bonds, const ContactModel& contact, double preload,
                 const Progress& progress)
        : packing_(packing),
          bonds_(bonds),
          progress_(progress),
          preload_(preload),
          overlap_(preload * mean_radius(packing)),
          law_(contact) {}

    /// Secant moduli [Pa] while the strain grows in this direction.
    std::vector<double> moduli(const ShearPlane& plane, double direction, const std::vector<double>& loads) const {
        std::vector<double> found;
        State state{0, Eigen::MatrixX2d::Zero(bonds_.size(), 2), Eigen::VectorXd::Zero(bonds_.size())};
        for (const double load : loads) {
            found.push_back(equilibrium(plane, direction * load * preload_, state));
        }
        return found;
    }

private:
    struct State {
        double strain;
        Eigen::MatrixX2d moved;  ///< change of every bond's overlap from that at rest, and how far its contact was sheared [m]
        Eigen::VectorXd shear;   ///< force [N]
    };

    /// The next one while the strain grows, by secant stiffnesses.
    double equilibrium(const ShearPlane& plane, double strain, State& state) const {
        const bool first = state.strain == 0;
        Eigen::MatrixX2d moved = state.moved * (first ? 0.0 : strain / state.strain);
        double modulus = 0;
        for (int iteration = 0; iteration < most_secant_iterations; ++iteration) {
            LinearOptions options;
            for (Index bond = 0; bond < bonds_.size(); ++bond) {
                options.bond_tangents.push_back(secant(bond, moved.row(bond), state));
            }
            const LinearResponse response = solve_linear(packing_, bonds_, options, progress_);
            const Eigen::MatrixX2d next = std::abs(strain) * moved_per_strain(plane, strain > 0 ? 1 : -1, response);
            moved = first && iteration == 0 ? next : (1 - share_of_new) * moved + share_of_new * next;
            const double before = std::exchange(modulus, response.elastic_tensor(plane.strain, plane.strain));
            if (modulus <= 0 || std::abs(modulus - before) < settled_modulus * modulus) {
                break;
            }
        }
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            state.shear[bond] = shear_force(bond, moved.row(bond), state);
        }
        state.moved = moved;
        state.strain = strain;
        return modulus;
    }

    double effective_radius(Index bond) const {
        const double first = packing_.radii[bonds_.ends(0, bond)];
        const double second = packing_.radii[bonds_.ends(1, bond)];
        return first * second / (first + second);
    }

    /// Mean of the normal stiffness of a bond over overlaps between these changes from that at rest.
    double normal_between(Index bond, double from, double to) const {
        const double radius = effective_radius(bond);
        const NormalResponse start = law_.normal(overlap_ + from, radius, true);
        const bool moved = std::abs(to - from) > 1e-9 * overlap_;
        return moved ? (law_.normal(overlap_ + to, radius, true).force - start.force) / (to - from) : start.stiffness;
    }

    /// Mindlin's shear stiffness grows as the normal one does.
    double shear_between(Index bond, double from, double to) const {
        const NormalResponse rest = law_.normal(overlap_, effective_radius(bond), true);
        return rest.shear_stiffness / rest.stiffness * normal_between(bond, from, to);
    }

    /// Grows with the shear stiffness of the moment.
    double shear_force(Index bond, const Eigen::RowVector2d& moved, const State& before) const {
        return before.shear[bond] + shear_between(bond, before.moved(bond, 0), moved[0]) * (moved[1] - before.moved(bond, 1));
    }

    /// Secant stiffness of a bond, whose normal force at rest another one balances.
    ContactTangent secant(Index bond, const Eigen::RowVector2d& moved, const State& before) const {
        const double tangent = shear_between(bond, before.moved(bond, 0), moved[0]);
        const double shear = moved[1] > 0 ? shear_force(bond, moved, before) / moved[1] : tangent;
        return {.normal = normal_between(bond, 0, moved[0]), .shear = std::max(shear, least_secant * tangent)};
    }

    /// Change of overlaps, and how far contacts are sheared, by a unit strain (engineering) in this direction.
    Eigen::MatrixX2d moved_per_strain(const ShearPlane& plane, double direction, const LinearResponse& response) const {
        const auto place = static_cast<std::size_t>(plane.strain);
        const Eigen::Matrix3Xd& displacement = response.displacement[place];
        const Eigen::Matrix3Xd& rotation = response.rotation[place];
        Eigen::MatrixX2d found(bonds_.size(), 2);
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            const Index i = bonds_.ends(0, bond);
            const Index j = bonds_.ends(1, bond);
            const Eigen::Vector3d branch = bonds_.branch.col(bond);
            const Eigen::Vector3d axis = branch.normalized();
            Eigen::Vector3d ends = displacement.col(j) - displacement.col(i);
            ends[plane.a] += 0.5 * branch[plane.b];
            ends[plane.b] += 0.5 * branch[plane.a];
            const double along = ends.dot(axis);
            const Eigen::Vector3d turned = (packing_.radii[i] * rotation.col(i) + packing_.radii[j] * rotation.col(j)) /
                                           (packing_.radii[i] + packing_.radii[j]);
            found.row(bond) << -direction * along, (ends - turned.cross(branch) - along * axis).norm();
        }
        return found;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    const Progress& progress_;
    double preload_;
    double overlap_;  ///< of contacts at rest [m]
    GeneralContact law_;
};

}  // namespace

std::vector<double> hertz_curve(const Packing& packing, const ContactNetwork& bonds, const ContactModel& contact, double preload,
                                const std::vector<double>& loads, const Progress& progress) {
    const HertzNetwork network(packing, bonds, contact, preload, progress);
    const LinearResponse springs = solve_linear(packing, bonds, {}, progress);
    double linear = 0;
    std::vector<double> curve(loads.size(), 0.0);
    for (const ShearPlane& plane : shear_planes) {
        linear += springs.elastic_tensor(plane.strain, plane.strain);
        for (const double direction : {1.0, -1.0}) {
            const std::vector<double> moduli = network.moduli(plane, direction, loads);
            for (std::size_t node = 0; node < loads.size(); ++node) {
                curve[node] += moduli[node] / 2;
            }
        }
    }
    for (double& modulus : curve) {
        modulus = linear > 0 ? modulus / linear : 1.0;
    }
    return curve;
}

}  // namespace coagula::mechanics
