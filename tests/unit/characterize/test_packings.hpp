// SPDX-License-Identifier: GPL-3.0-or-later
// Packings that the tests of coagula::characterize share: lattices, random sets and measured structures.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>

#include "support/reference_data.hpp"

#include <array>
#include <vector>

namespace coagula::characterize::test {

/// A periodic lattice of cubic cells of edge a with the given basis (fractions of a).
inline Packing lattice(const std::vector<Eigen::Vector3d>& basis, double a, const Eigen::Vector3i& cells, double radius) {
    std::vector<Eigen::Vector3d> points;
    for (int x = 0; x < cells[0]; ++x) {
        for (int y = 0; y < cells[1]; ++y) {
            for (int z = 0; z < cells[2]; ++z) {
                for (const Eigen::Vector3d& site : basis) {
                    points.emplace_back(a * (Eigen::Vector3d(x, y, z) + site));
                }
            }
        }
    }
    Packing packing;
    packing.cell = Cell::periodic(a * cells.cast<double>());
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, static_cast<Index>(points.size()));
    packing.radii = Eigen::VectorXd::Constant(packing.size(), radius);
    return packing;
}

// Lattices of touching spheres of the given radius.
inline Packing simple_cubic(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}}, 2 * radius, cells, radius);
}
inline Packing body_centred(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}, {.5, .5, .5}}, 4 * radius / std::sqrt(3.0), cells, radius);
}
inline Packing face_centred(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}}, 2 * std::sqrt(2.0) * radius, cells, radius);
}

/// Points uniform at random (spheres overlap), radii uniform between the two given.
inline Packing random_spheres(Index particles, const Eigen::Vector3d& lengths, double smallest, double largest,
                              std::uint64_t seed) {
    Packing packing;
    packing.cell = Cell::periodic(lengths);
    packing.positions.resize(3, particles);
    packing.radii.resize(particles);
    for (Index i = 0; i < particles; ++i) {
        const auto id = static_cast<std::uint64_t>(i);
        packing.positions.col(i) = random_uniform(seed, RandomPurpose::test, 0, id).cwiseProduct(lengths);
        packing.radii[i] = smallest + (largest - smallest) * random_uniform(seed, RandomPurpose::test, 1, id)[0];
    }
    return packing;
}

/// Holds pieces of memory with gaps between, so that what is allocated next lies elsewhere: results must not depend on addresses.
class ScatteredMemory {
public:
    void scatter() {
        ++times_;
        for (std::size_t piece = 0; piece < 100; ++piece) {
            pieces_.emplace_back(1000 * times_ + 37 * piece);
        }
        for (std::size_t piece = times_; piece < pieces_.size(); piece += 3) {
            pieces_[piece] = std::vector<char>();
        }
    }

private:
    std::size_t times_ = 0;
    std::vector<std::vector<char>> pieces_;
};

using coagula::testing::read_columns;
using coagula::testing::reference_structure;

}  // namespace coagula::characterize::test
