// SPDX-License-Identifier: GPL-3.0-or-later
// Small networks for tests of quasi-static shear.
#pragma once

#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/quasistatic.hpp>

#include <vector>

namespace coagula::mechanics::quasistatic_examples {

inline constexpr double radius = 0.25e-6;
inline constexpr ShearOrientation zx{2, 0};

inline double stress_zx(const StrainPoint& point) {
    return point.stress(2, 0);
}

/// One particle per column, or two, bonded by the given branches.
struct Columns {
    Packing packing;
    ContactNetwork bonds;

    Columns(const Eigen::Vector3d& lengths, const std::vector<double>& radii) {
        packing.cell = Cell::periodic(lengths);
        packing.positions.resize(3, static_cast<Index>(radii.size()));
        packing.radii = Eigen::Map<const Eigen::VectorXd>(radii.data(), packing.positions.cols());
        for (Index k = 0; k < packing.size(); ++k) {
            packing.positions.col(k) << 0.1 * lengths.x() + 6 * radius * static_cast<double>(k), 0.5 * lengths.y(),
                0.1 * lengths.z();
        }
        bonds.particles = packing.size();
    }
    void join(int particle, const Eigen::Vector3d& branch) { join(particle, particle, branch); }
    void join(int first, int second, const Eigen::Vector3d& branch) {
        bonds.ends.conservativeResize(2, bonds.size() + 1);
        bonds.branch.conservativeResize(3, bonds.ends.cols());
        bonds.ends.rightCols<1>() << first, second;
        bonds.branch.rightCols<1>() = branch;
    }
};

inline ContactModel springs(double normal = 100, double shear = 10) {
    ContactModel model;
    model.normal_stiffness = normal;
    model.shear_stiffness = shear;
    return model;
}

inline generators::VoidExpansion gel(Index particles) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 2;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(particles, radius);
    return generators::expand_voids(options);
}

}  // namespace coagula::mechanics::quasistatic_examples
