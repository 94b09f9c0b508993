#include "hertz_curve.hpp"

#include <coagula/diagnose/model.hpp>

#include <coagula/common/general_contact.hpp>
#include <coagula/mechanics/linear.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double preload = 1e-4;    // only the load counts
constexpr double converged = 1e-3;  // of the modulus: nodes half a decade apart do not tell more
constexpr int most_iterations = 20;
constexpr double share_of_new = 0.7;  // in the overlaps of the next iteration: stiffer bonds stretch less, so that they overshoot

/// Plane a-b and its place among the strains (Voigt).
struct Plane {
    int a;
    int b;
    int strain;
};
constexpr std::array<Plane, 3> planes{{{1, 2, 3}, {0, 2, 4}, {0, 1, 5}}};

class HertzNetwork {
public:
    HertzNetwork(const Packing& packing, const ContactNetwork& bonds, const Progress& progress)
        : packing_(packing), bonds_(bonds), progress_(progress), radius_(mean_radius(packing)), law_(model()) {}

    /// Secant moduli [Pa] while the strain grows in this direction.
    std::vector<double> moduli(const Plane& plane, double direction, const std::vector<double>& loads) const {
        std::vector<double> found;
        Eigen::VectorXd change = Eigen::VectorXd::Zero(bonds_.size());
        double before = loads.front();
        for (const double load : loads) {
            change *= load / std::exchange(before, load);
            found.push_back(equilibrium(plane, direction * load * preload, change));
        }
        return found;
    }

private:
    ContactModel model() const {
        Settings settings;
        settings.contact_preload = preload;
        return contact_model_of(settings, radius_);
    }

    /// By secant stiffnesses. @param change of the overlaps from those at rest [m]: a guess, then that of the equilibrium.
    double equilibrium(const Plane& plane, double strain, Eigen::VectorXd& change) const {
        double modulus = 0;
        for (int iteration = 0; iteration < most_iterations; ++iteration) {
            mechanics::LinearOptions options;
            for (Index bond = 0; bond < bonds_.size(); ++bond) {
                options.bond_tangents.push_back(secant(bond, change[bond]));
            }
            const mechanics::LinearResponse response = mechanics::solve_linear(packing_, bonds_, options, progress_);
            const auto place = static_cast<std::size_t>(plane.strain);
            const Eigen::VectorXd next = strain * overlaps_per_strain(plane, response.displacement[place]);
            change = iteration == 0 && change.isZero(0) ? next : (1 - share_of_new) * change + share_of_new * next;
            const double before = std::exchange(modulus, response.elastic_tensor(plane.strain, plane.strain));
            if (modulus <= 0 || std::abs(modulus - before) < converged * modulus) {
                break;
            }
        }
        return modulus;
    }

    /// Secant stiffness of a bond whose overlap changed from that at rest, where another force balances it. Mindlin's shear stiffness
    /// grows on the way as the normal one does, so that their secants keep the ratio.
    ContactTangent secant(Index bond, double change) const {
        const double first = packing_.radii[bonds_.ends(0, bond)];
        const double second = packing_.radii[bonds_.ends(1, bond)];
        const double effective_radius = first * second / (first + second);
        const double overlap = preload * radius_;
        const NormalResponse rest = law_.normal(overlap, effective_radius, true);
        const bool moved = std::abs(change) > 1e-9 * overlap;
        const double force = law_.normal(overlap + change, effective_radius, true).force;
        const double normal = moved ? (force - rest.force) / change : rest.stiffness;
        return {.normal = normal, .shear = normal * rest.shear_stiffness / rest.stiffness};
    }

    /// Of every bond by a unit shear strain (engineering) with the displacements found for it [m].
    Eigen::VectorXd overlaps_per_strain(const Plane& plane, const Eigen::Matrix3Xd& displacement) const {
        Eigen::VectorXd overlap(bonds_.size());
        for (Index bond = 0; bond < bonds_.size(); ++bond) {
            const Eigen::Vector3d branch = bonds_.branch.col(bond);
            Eigen::Vector3d moved = displacement.col(bonds_.ends(1, bond)) - displacement.col(bonds_.ends(0, bond));
            moved[plane.a] += 0.5 * branch[plane.b];
            moved[plane.b] += 0.5 * branch[plane.a];
            overlap[bond] = -moved.dot(branch) / branch.norm();
        }
        return overlap;
    }

    const Packing& packing_;
    const ContactNetwork& bonds_;
    const Progress& progress_;
    double radius_;
    GeneralContact law_;
};

}  // namespace

std::vector<double> hertz_curve(const Packing& packing, const ContactNetwork& bonds, const std::vector<double>& loads,
                                const Progress& progress) {
    const HertzNetwork network(packing, bonds, progress);
    const mechanics::LinearResponse springs = mechanics::solve_linear(packing, bonds, {}, progress);
    double linear = 0;
    std::vector<double> curve(loads.size(), 0.0);
    for (const Plane& plane : planes) {
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

}  // namespace coagula::diagnose
