// SPDX-License-Identifier: GPL-3.0-or-later
// Void expansion: time, steps and the structure that comes out. Usage: bench_vem [N [N_V [seed [target C [volume fraction]]]]]
#include <coagula/characterize/heterogeneity.hpp>
#include <coagula/characterize/pore_sizes.hpp>
#include <coagula/generators/void_expansion.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>

int main(int argc, char** argv) {
    coagula::generators::VoidExpansionOptions options;
    options.particles = argc > 1 ? std::atol(argv[1]) : 8000;
    options.voids = argc > 2 ? std::atol(argv[2]) : options.particles / 2;
    options.seed = argc > 3 ? static_cast<std::uint64_t>(std::atoll(argv[3])) : 1;
    options.target_coordination = argc > 4 ? std::atof(argv[4]) : 4.69;
    options.volume_fraction = argc > 5 ? std::atof(argv[5]) : 0.4;
    options.radii = Eigen::VectorXd::Constant(options.particles, 0.25e-6);
    try {
        const auto start = std::chrono::steady_clock::now();
        const coagula::generators::VoidExpansion result = coagula::generators::expand_voids(options);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        const double cpu_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
        const auto pores = coagula::characterize::measure_pores(result.packing);
        const double a = coagula::characterize::fit_degree_of_heterogeneity(pores, 0.25e-6).a;
        std::printf(
            "N %ld  N_V %ld  seed %llu: %.2f s, CPU %.2f s, %ld increments, %ld steps, a %.4f, C %.3f, overlap rms %.4f %% max "
            "%.3f %%, "
            "void radius %.3f r0\n",
            static_cast<long>(options.particles), static_cast<long>(options.voids), static_cast<unsigned long long>(options.seed),
            seconds.count(), cpu_seconds, static_cast<long>(result.increments), static_cast<long>(result.steps), a,
            result.coordination, 100 * result.overlap_rms, 100 * result.overlap_max, result.void_radius / 0.25e-6);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_vem: %s\n", error.what());
        return 1;
    }
    return 0;
}
