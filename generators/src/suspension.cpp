// SPDX-License-Identifier: GPL-3.0-or-later
// Where the particles of a suspension are put at random.
#include <coagula/generators/brownian_dynamics.hpp>

#include <coagula/common/dem/minimise.hpp>
#include <coagula/common/failures.hpp>
#include <coagula/common/random.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace coagula::generators {

Packing place_suspension(const SuspensionOptions& options, const Progress& progress) {
    require_between(options.volume_fraction, 0, 0.55, "the volume fraction of a suspension");
    require(options.radii.size() >= 2, "a suspension needs at least 2 particles");
    for (Index particle = 0; particle < options.radii.size(); ++particle) {
        require_positive(options.radii[particle], "the radius of particle " + std::to_string(particle), "m");
    }
    constexpr double gap = 0.1;           // of the radius, on each side
    constexpr double most_filled = 0.58;  // volume fraction of the spheres with their gaps: random ones still come apart
    constexpr double settled = 1e-6;      // rms force in units of stiffness and radius
    constexpr Index most_iterations = 100000;
    const double unit = options.radii.mean();
    const Eigen::VectorXd radii = options.radii / unit;
    const double solid = 4 * std::numbers::pi / 3 * radii.array().cube().sum();
    const Cell cell = Cell::periodic(Eigen::Vector3d::Constant(std::cbrt(solid / options.volume_fraction)));
    Eigen::Matrix3Xd positions(3, radii.size());
    for (Index particle = 0; particle < radii.size(); ++particle) {
        const auto number = static_cast<std::uint64_t>(particle);
        positions.col(particle) =
            random_uniform(options.seed, RandomPurpose::initial_position, 0, number).cwiseProduct(cell.lengths());
    }
    const double growth = std::min(1 + gap, std::cbrt(most_filled / options.volume_fraction));
    dem::ParticleSystem system(cell, positions, growth * radii, 0.6);
    dem::Fire fire(system, dem::Interactions<RepulsiveSpring, BondSpring>{RepulsiveSpring(1.0), BondSpring(1.0)}, 0.3, 0.6);
    Index iterations = 0;
    while (fire.iterate() > settled) {
        progress.update("placing particles", 0.0);
        if (++iterations > most_iterations) {
            throw OutOfReach("the particles cannot be moved apart at volume fraction " + to_text(options.volume_fraction) +
                             ": ask for a lower one");
        }
    }
    return {Cell::periodic(unit * cell.lengths()), unit * system.positions(), options.radii};
}

}  // namespace coagula::generators
