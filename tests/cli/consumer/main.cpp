// SPDX-License-Identifier: GPL-3.0-or-later
// A program of somebody else: coordination number of a simple cubic lattice.
#include <coagula/characterize/coordination.hpp>
#include <coagula/characterize/pore_sizes.hpp>

#include <iostream>

int main() {
    coagula::Packing packing;
    packing.cell = coagula::Cell::periodic(Eigen::Vector3d::Constant(8.0));
    packing.radii = Eigen::VectorXd::Ones(64);
    packing.positions.resize(3, 64);
    for (int i = 0; i < 64; ++i) {
        packing.positions.col(i) = 2.0 * Eigen::Vector3i(i % 4, i / 4 % 4, i / 16).cast<double>();
    }
    std::cout << coagula::characterize::measure_coordination(packing).mean << ' '
              << coagula::characterize::measure_pores(packing).void_fraction << '\n';
}
