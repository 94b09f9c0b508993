// SPDX-License-Identifier: GPL-3.0-or-later
// Quasi-static amplitude sweep with breaking bonds: time and effort, amplitude by amplitude.
// Usage: bench_quasistatic [N [N_V [seed [strength N [from [to [amplitudes]]]]]]]
#include <coagula/common/logarithmic_steps.hpp>
#include <coagula/generators/void_expansion.hpp>
#include <coagula/mechanics/quasistatic.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

namespace {

using namespace coagula;

double argument(int argc, char** argv, int position, double otherwise) {
    return argc > position ? std::atof(argv[position]) : otherwise;
}

/// Amplitudes in logarithmic steps, up and down again.
std::vector<double> up_and_down(double from, double to, int number) {
    std::vector<double> amplitudes = logarithmic_steps(from, to, number);
    const std::vector<double> up = amplitudes;
    amplitudes.insert(amplitudes.end(), up.rbegin(), up.rend());
    return amplitudes;
}

void print(const mechanics::SweepResponse& sweep) {
    std::printf("amplitude   G' MPa     G'' MPa    broken  bonds  balance\n");
    for (const mechanics::AmplitudeResponse& entry : sweep.amplitudes) {
        std::printf("%.3e  %.6f  %.6f  %6ld  %5ld  %.1e\n", entry.amplitude, entry.storage_modulus / 1e6, entry.loss_modulus / 1e6,
                    static_cast<long>(entry.broken), static_cast<long>(entry.bonds), entry.balance_error);
    }
}

void run(int argc, char** argv) {
    generators::VoidExpansionOptions options;
    options.particles = static_cast<Index>(argument(argc, argv, 1, 2000));
    options.voids = static_cast<Index>(argument(argc, argv, 2, static_cast<double>(options.particles) / 2));
    options.seed = static_cast<std::uint64_t>(argument(argc, argv, 3, 1));
    options.volume_fraction = 0.4;
    options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
    const generators::VoidExpansion sample = generators::expand_voids(options);

    ContactModel model;
    model.normal_stiffness = 100;
    model.shear_stiffness = 10;
    model.bending_stiffness = 3e-14;
    model.normal_strength = argument(argc, argv, 4, 4e-9);
    model.friction = 0.3;
    mechanics::SweepOptions protocol;
    protocol.amplitudes =
        up_and_down(argument(argc, argv, 5, 1e-4), argument(argc, argv, 6, 1e-3), static_cast<int>(argument(argc, argv, 7, 20)));
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t processor = std::clock();
    const mechanics::SweepResponse sweep = sweep_amplitudes(sample.packing, sample.contacts, model, protocol);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print(sweep);
    std::printf(
        "N %ld, %ld bonds, %zu broken: wall %.1f s, processor %.1f s; %ld steps, %ld jumps, %ld factorisations, %ld "
        "solutions, %ld evaluations\n",
        static_cast<long>(options.particles), static_cast<long>(sample.contacts.size()), sweep.broken.size(), seconds.count(),
        static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC, static_cast<long>(sweep.effort.steps),
        static_cast<long>(sweep.effort.jumps), static_cast<long>(sweep.effort.factorisations),
        static_cast<long>(sweep.effort.solutions), static_cast<long>(sweep.effort.evaluations));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_quasistatic: %s\n", error.what());
        return 1;
    }
    return 0;
}
