// SPDX-License-Identifier: GPL-3.0-or-later
// Crystals of equal spheres that touch, for tests against closed forms.
#pragma once

#include <coagula/common/packing.hpp>

#include <vector>

namespace coagula::testing {

/// Fractional basis of a cubic crystal and the edge of its cubic cell in radii of touching spheres.
struct Lattice {
    std::vector<Eigen::Vector3d> basis;
    double edge_in_radii;
};

inline Lattice simple_cubic() {
    return {{{0, 0, 0}}, 2.0};
}
inline Lattice body_centred_cubic() {
    return {{{0, 0, 0}, {0.5, 0.5, 0.5}}, 4 / std::sqrt(3.0)};
}
inline Lattice face_centred_cubic() {
    return {{{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}, 2 * std::sqrt(2.0)};
}

/// nx x ny x nz cubic cells of touching spheres of the given radius [m].
inline Packing make_lattice(const Lattice& lattice, int nx, int ny, int nz, double radius = 0.25e-6) {
    const double edge = lattice.edge_in_radii * radius;
    Packing packing;
    packing.cell = Cell::periodic(edge * Eigen::Vector3d(nx, ny, nz));
    packing.positions.resize(3, static_cast<Index>(lattice.basis.size()) * nx * ny * nz);
    Index particle = 0;
    for (int z = 0; z < nz; ++z) {
        for (int y = 0; y < ny; ++y) {
            for (int x = 0; x < nx; ++x) {
                for (const Eigen::Vector3d& site : lattice.basis) {
                    packing.positions.col(particle++) = edge * (Eigen::Vector3d(x, y, z) + site);
                }
            }
        }
    }
    packing.radii = Eigen::VectorXd::Constant(packing.positions.cols(), radius);
    return packing;
}

}  // namespace coagula::testing
