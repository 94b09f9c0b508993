// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a packing and prints its shear modulus.
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/linear.hpp>

#include <iostream>

int main() {
    coagula::generators::VoidExpansionOptions options;
    options.particles = 300;
    options.voids = 150;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
    const auto made = coagula::generators::expand_voids(options);
    const auto response = coagula::mechanics::solve_linear(made.packing, made.contacts);
    std::cout << "G' = " << response.mean_shear_modulus() / 1e6 << " MPa\n";
}
