// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/plate_stiffening.hpp>

#include "explicit/plates.hpp"
#include "response/bond_tangents.hpp"
#include "response/linear_solution.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace coagula::mechanics {

namespace {

/// Simple shear along both directions in the plates is unit shear strain yz, xz or xy of vectors along the normal: the strain moves
/// the ends of a bond apart by half their distance along the normal (it is symmetric), hence twice that distance. Outside the
/// sample nothing moves.
Eigen::Matrix3Xd strained_parts(const MountedSample& mounted, int normal) {
    const ContactNetwork& bonds = mounted.bonds;
    Eigen::Matrix3Xd strained = Eigen::Matrix3Xd::Zero(3, bonds.size());
    const auto inside = [&](double place) { return std::clamp(place, mounted.bottom, mounted.bottom + mounted.height); };
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const double from = mounted.packing.positions(normal, bonds.ends(0, bond));
        strained(normal, bond) = 2 * (inside(from + bonds.branch(normal, bond)) - inside(from));
    }
    return strained;
}

std::vector<bool> held_in(const MountedSample& mounted) {
    std::vector<bool> held(static_cast<std::size_t>(mounted.packing.size()), false);
    for (const std::vector<Index>& plate : {mounted.lower, mounted.upper}) {
        for (const Index particle : plate) {
            held[static_cast<std::size_t>(particle)] = true;
        }
    }
    return held;
}

std::vector<ContactTangent> repeated(const std::vector<ContactTangent>& tangents, const std::vector<Index>& origin) {
    std::vector<ContactTangent> all;
    all.reserve(origin.size());
    for (const Index bond : origin) {
        all.push_back(tangents[static_cast<std::size_t>(bond)]);
    }
    return all;
}

/// Twice the energy per volume and strain squared under the six unit strains of plates with that normal [Pa].
Eigen::Matrix<double, 6, 1> moduli(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& periodic, int normal,
                                   double plate_layers, const LinearOptions& options, const Progress& progress) {
    RheometerOptions between;
    between.plate_layers = plate_layers;
    const MountedSample mounted = mount(packing, bonds, between, {normal, (normal + 1) % 3});
    const std::vector<ContactTangent> tangents = repeated(periodic.bond_tangents, mounted.bond_origin);
    LoadBearing kept = find_load_bearing(mounted.bonds, held_in(mounted), resist_moments(tangents));
    sort_along_curve(kept, mounted.bonds, mounted.packing);
    LinearNetwork network(mounted.packing, mounted.bonds, kept, tangents, periodic.contact_normal_stiffness);
    network.strain(strained_parts(mounted, normal));
    Loads motion = Loads::Zero(6 * network.particles(), 6);
    if (network.particles() > 0) {
        motion = solve_network(network, mounted.packing, kept, options, progress).motion;
    }
    const double r0 = mean_radius(mounted.packing);
    return periodic.contact_normal_stiffness * r0 * r0 / mounted.volume() * network.energy(motion).diagonal();
}

}  // namespace

std::vector<PlateStiffening> plate_stiffening(const Packing& packing, const ContactNetwork& bonds, const LinearResponse& periodic,
                                              const std::vector<ShearOrientation>& orientations, double plate_layers,
                                              const LinearOptions& options, const Progress& progress) {
    require(packing.cell.is_periodic(), "the packing has a free surface: plates need a periodic cell");
    require(periodic.bond_tangents.size() == static_cast<std::size_t>(bonds.size()),
            "the linear response belongs to " + std::to_string(periodic.bond_tangents.size()) + " bonds, but there are " +
                std::to_string(bonds.size()));
    require_positive(plate_layers, "the number of layers of a plate");
    std::vector<PlateStiffening> found;
    found.reserve(orientations.size());
    for (const ShearOrientation& orientation : orientations) {
        found.push_back({orientation, unset, periodic.shear_modulus(orientation.normal, orientation.direction)});
    }
    for (int normal = 0; normal < 3; ++normal) {
        const auto has_normal = [&](const PlateStiffening& one) { return one.orientation.normal == normal; };
        if (std::none_of(found.begin(), found.end(), has_normal)) {
            continue;
        }
        const auto all = moduli(packing, bonds, periodic, normal, plate_layers, options, progress);
        for (PlateStiffening& one : found) {
            one.between_plates = has_normal(one) ? all[one.orientation.voigt()] : one.between_plates;
        }
    }
    return found;
}

}  // namespace coagula::mechanics
