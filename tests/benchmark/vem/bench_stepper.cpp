// Explicit steps of a bonded network with shear springs and rotations: million particle-steps per second.
// Usage: bench_stepper [N [steps]]
#include <coagula/common/dem/stepper.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

int main(int argc, char** argv) {
    using namespace coagula;
    generators::VoidExpansionOptions options;
    options.particles = argc > 1 ? std::atol(argv[1]) : 8000;
    options.voids = options.particles / 8;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Ones(options.particles);
    const generators::VoidExpansion made = generators::expand_voids(options);
    dem::ParticleSystem system(made.packing.cell, made.packing.positions, made.packing.radii, 0.1);
    system.add_bonds(made.contacts);
    Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, options.particles);
    velocities.row(0) = 1e-4 * made.packing.positions.row(2).array().sin().matrix();
    system.set_velocities(velocities);
    const dem::Interactions<RepulsiveSpring, BondedContact> laws{RepulsiveSpring(1.0), BondedContact(1.0, 0.1)};
    const long steps = argc > 2 ? std::atol(argv[2]) : 4000;
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    for (long count = 0; count < steps; ++count) {
        dem::step(system, laws, {.time_step = 0.2, .damping = 0.9});
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const double work = 1e-6 * static_cast<double>(steps) * static_cast<double>(options.particles);
    std::printf(
        "N %ld  C %.3f  %ld steps: %.1f million particle-steps/s, %.1f per CPU second, %ld neighbour lists, rms force %.3g\n",
        static_cast<long>(options.particles), made.coordination, steps, work / seconds.count(),
        work * CLOCKS_PER_SEC / static_cast<double>(std::clock() - cpu), static_cast<long>(system.list_builds()),
        dem::rms_force(system));
    return 0;
}
