// SPDX-License-Identifier: GPL-3.0-or-later
#include "plates.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace coagula::mechanics {

namespace {

/// Particles by what they repeat and how many periods away along the normal.
using Copies = std::map<std::pair<Index, int>, Index>;

/// Periods along the normal that a bond passes from the wrapped place of its first to that of its second particle.
int periods_of(const Packing& packing, const ContactNetwork& bonds, Index bond, int normal) {
    const double direct = packing.positions(normal, bonds.ends(1, bond)) - packing.positions(normal, bonds.ends(0, bond));
    return static_cast<int>(std::lround((bonds.branch(normal, bond) - direct) / packing.cell.lengths()[normal]));
}

void add_copy(MountedSample& mounted, const Packing& packing, Index particle, int periods, int normal, Copies& copies) {
    const auto column = static_cast<Index>(mounted.origin.size());
    mounted.origin.push_back(particle);
    mounted.packing.positions.col(column) = packing.positions.col(particle);
    mounted.packing.positions(normal, column) += periods * packing.cell.lengths()[normal] + mounted.bottom;
    mounted.packing.radii[column] = packing.radii[particle];
    copies[{particle, periods}] = column;
    if (periods != 0) {
        (periods < 0 ? mounted.lower : mounted.upper).push_back(column);
    }
}

/// Adds the bonds among the copies, apart from those inside a plate.
void repeat_bonds(MountedSample& mounted, const Packing& packing, const ContactNetwork& bonds, const Copies& copies, int reach,
                  int normal) {
    ContactNetwork& repeated = mounted.bonds;
    std::vector<Index>& which = mounted.bond_origin;
    std::vector<std::pair<Index, Index>> ends;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const int periods = periods_of(packing, bonds, bond, normal);
        for (int from = -reach; from <= reach; ++from) {
            const auto first = copies.find({bonds.ends(0, bond), from});
            const auto second = copies.find({bonds.ends(1, bond), from + periods});
            if (first != copies.end() && second != copies.end() && (from == 0 || from + periods == 0)) {
                ends.emplace_back(first->second, second->second);
                which.push_back(bond);
            }
        }
    }
    repeated.ends.resize(2, static_cast<Index>(ends.size()));
    repeated.branch.resize(3, static_cast<Index>(ends.size()));
    for (std::size_t entry = 0; entry < ends.size(); ++entry) {
        repeated.ends.col(static_cast<Index>(entry)) << static_cast<std::int32_t>(ends[entry].first),
            static_cast<std::int32_t>(ends[entry].second);
        repeated.branch.col(static_cast<Index>(entry)) = bonds.branch.col(which[entry]);
    }
    repeated.particles = mounted.packing.size();
}

/// Whether the image `periods` away lies within `thickness` of the sample.
bool is_in_plate(double place, int periods, double height, double thickness) {
    const double z = place + periods * height;
    return (z < 0 && z >= -thickness) || (z >= height && z < height + thickness);
}

}  // namespace

MountedSample mount(const Packing& packing, const ContactNetwork& bonds, const RheometerOptions& options,
                    const ShearOrientation& orientation) {
    const Eigen::Vector3d lengths = packing.cell.lengths();
    MountedSample mounted;
    mounted.height = lengths[orientation.normal];
    mounted.area = packing.cell.volume() / mounted.height;
    if (options.boundary == RheometerBoundary::periodic) {
        mounted.packing = packing;
        mounted.bonds = bonds;
        for (Index particle = 0; particle < packing.size(); ++particle) {
            mounted.origin.push_back(particle);
        }
        mounted.bond_origin.resize(static_cast<std::size_t>(bonds.size()));
        std::iota(mounted.bond_origin.begin(), mounted.bond_origin.end(), Index{0});
        return mounted;
    }
    const double diameter = 2 * mean_radius(packing);
    const double thickness = options.plate_layers * diameter;
    const double room = 2 * (packing.radii.maxCoeff() + diameter);  // the backs of the plates must not meet
    mounted.bottom = thickness + 0.5 * room;
    Eigen::Vector3d outer = lengths;
    outer[orientation.normal] += 2 * thickness + room;

    const int reach = static_cast<int>(std::ceil(thickness / mounted.height));
    Copies copies;
    std::vector<std::pair<Index, int>> wanted;
    for (Index particle = 0; particle < packing.size(); ++particle) {
        wanted.emplace_back(particle, 0);
    }
    for (int periods = -reach; periods <= reach; ++periods) {
        for (Index particle = 0; particle < packing.size(); ++particle) {
            if (periods != 0 && is_in_plate(packing.positions(orientation.normal, particle), periods, mounted.height, thickness)) {
                wanted.emplace_back(particle, periods);
            }
        }
    }
    mounted.packing.cell = Cell::periodic(outer);
    mounted.packing.positions.resize(3, static_cast<Index>(wanted.size()));
    mounted.packing.radii.resize(static_cast<Index>(wanted.size()));
    for (const auto& [particle, periods] : wanted) {
        add_copy(mounted, packing, particle, periods, orientation.normal, copies);
    }
    repeat_bonds(mounted, packing, bonds, copies, reach + 1, orientation.normal);
    return mounted;
}

}  // namespace coagula::mechanics
