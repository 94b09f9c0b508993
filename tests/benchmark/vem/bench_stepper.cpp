// SPDX-License-Identifier: GPL-3.0-or-later
// Explicit steps of a bonded network with shear springs, rotations and local damping: million particle-steps per second on one core
// and on two, the best of several rounds.
// With OMP_NUM_THREADS=1, on one core only.
// Usage: bench_stepper [N [steps [copies]]]: a structure of N particles from void expansion, `copies` of it along each axis.
#include <coagula/common/dem/stepper.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

namespace {

using namespace coagula;

struct Network {
    Packing packing;
    ContactNetwork bonds;
};

Network make_network(Index particles) {
    generators::VoidExpansionOptions options;
    options.particles = particles;
    options.voids = particles / 8;
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Ones(particles);
    const generators::VoidExpansion made = generators::expand_voids(options);
    return {made.packing, made.contacts};
}

/// The periodic network as part of a larger cell. Bonds are found anew: they are the contacts.
Network repeated(const Network& network, int copies) {
    const Eigen::Vector3d lengths = network.packing.cell.lengths();
    const Index particles = network.packing.size();
    const Index cells = Index{copies} * copies * copies;
    Network large{
        {Cell::periodic(copies * lengths), Eigen::Matrix3Xd(3, cells * particles), network.packing.radii.replicate(cells, 1)}, {}};
    for (Index cell = 0; cell < cells; ++cell) {
        const Eigen::Array<Index, 3, 1> along(cell % copies, cell / copies % copies, cell / copies / copies);
        const Eigen::Array3d place = along.cast<double>();
        large.packing.positions.middleCols(cell * particles, particles) =
            network.packing.positions.colwise() + (place * lengths.array()).matrix();
    }
    large.bonds = find_contacts(large.packing, generators::VoidExpansionOptions{}.contact_tolerance);
    return large;
}

/// Million particle-steps per second of wall time and of processor time.
struct Rate {
    double wall = 0;
    double processor = 0;
};

Rate measure(const Network& network, long steps, int threads) {
    const Index particles = network.packing.size();
    dem::ParticleSystem system(network.packing.cell, network.packing.positions, network.packing.radii, 0.1);
    system.add_bonds(network.bonds);
    Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, particles);
    velocities.row(0) = 1e-4 * network.packing.positions.row(2).array().sin().matrix();
    system.set_velocities(velocities);
    const dem::Interactions<RepulsiveSpring, BondedContact> laws{RepulsiveSpring(1.0), BondedContact(1.0, 0.1)};
    omp_set_num_threads(threads);
    const double work = 1e-6 * static_cast<double>(steps) * static_cast<double>(particles);
    constexpr int rounds = 5;
    Rate best;
    for (int round = 0; round < rounds; ++round) {
        const std::clock_t processor = std::clock();
        const auto start = std::chrono::steady_clock::now();
        for (long count = 0; count < steps; ++count) {
            dem::step(system, laws, {.time_step = 0.2, .damping = 0.9});
        }
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        best.wall = std::max(best.wall, work / seconds.count());
        best.processor = std::max(best.processor, work * CLOCKS_PER_SEC / static_cast<double>(std::clock() - processor));
    }
    std::printf("  %d thread%s: %5.1f (per processor second %.1f); %ld neighbour lists, rms force %.3g\n", threads,
                threads == 1 ? " " : "s", best.wall, best.processor, static_cast<long>(system.list_builds()),
                dem::rms_force(system));
    return best;
}

}  // namespace

int main(int argc, char** argv) {
    const Index particles = argc > 1 ? std::atol(argv[1]) : 8000;
    const long steps = argc > 2 ? std::atol(argv[2]) : 1000;
    const int copies = argc > 3 ? std::atoi(argv[3]) : 1;
    try {
        const int most_threads = omp_get_max_threads();
        const Network network = repeated(make_network(particles), copies);
        std::printf("N %ld, %ld bonds, %ld steps a round; million particle-steps per second:\n",
                    static_cast<long>(network.packing.size()), static_cast<long>(network.bonds.size()), steps);
        const Rate one = measure(network, steps, 1);
        if (most_threads > 1) {
            const Rate two = measure(network, steps, 2);
            std::printf("  two threads / one: %.2f\n", two.wall / one.wall);
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_stepper: %s\n", error.what());
        return 1;
    }
    return 0;
}
