// SPDX-License-Identifier: GPL-3.0-or-later
// Packings for the tests of the files.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>

namespace coagula::io {

/// Points on a disturbed lattice in a box whose edges are no round numbers, and unequal radii.
inline Packing example_packing(Index particles, bool periodic) {
    Packing packing;
    const Eigen::Vector3d lengths(3.1e-6, 2.7e-6, 4.0000001e-6);
    const Eigen::Vector3d lower(-1.3e-6, 0.7e-6, 1e-9 / 3);
    packing.cell = periodic ? Cell::periodic(lengths) : Cell::open(lower, lengths);
    packing.positions.resize(3, particles);
    packing.radii.resize(particles);
    const auto side = static_cast<Index>(std::ceil(std::cbrt(static_cast<double>(particles))));
    for (Index i = 0; i < particles; ++i) {
        const Eigen::Vector3d noise = random_uniform(1, RandomPurpose::test, 0, static_cast<std::uint64_t>(i));
        const Eigen::Matrix<Index, 3, 1> place(i % side, i / side % side, i / side / side);
        const Eigen::Vector3d site = place.cast<double>() + 0.5 * noise;
        packing.positions.col(i) = packing.cell.origin() + (site / static_cast<double>(side)).cwiseProduct(lengths);
        packing.radii[i] = 2.7e-6 / static_cast<double>(side) * (0.4 + 0.1 * noise[0]);
    }
    return packing;
}

}  // namespace coagula::io
