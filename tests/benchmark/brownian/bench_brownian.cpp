// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of a coagulating suspension with DLVO forces: million particle-steps per second, and million force evaluations of a
// particle per second (a step has several stages), of wall time and of processor time. Usage: bench_brownian [N [surface potential
// in mV [steps [threads]]]]
#include <coagula/generators/brownian_dynamics.hpp>

#include <omp.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

using namespace coagula;
using namespace coagula::generators;

constexpr double radius = 0.25e-6;

PairPotential dlvo(double surface_potential) {
    constexpr double temperature = 293;
    const PairRadii radii{radius, radius};
    return {{HamakerAttraction(4.76e-20, radii), LinearSuperposition({surface_potential, 10e-9, 81, temperature, 1}, radii)},
            {4e5 * boltzmann_constant * temperature / (radius * radius), 0.004 * radius}};
}

BrownianRun timed_run(const char* name, const Packing& start, double surface_potential, double steps) {
    const PairPotential potential = dlvo(surface_potential);
    BrownianOptions options;
    options.stop_time = steps * choose_time_step(potential, radius, radius, options).time_step;
    options.sample_interval = options.stop_time;
    const std::clock_t processor = std::clock();
    const auto begin = std::chrono::steady_clock::now();
    BrownianRun run = simulate_brownian(start, potential, options);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
    const double busy = static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC;
    const double work = 1e-6 * static_cast<double>(run.steps) * static_cast<double>(start.size());
    std::printf(
        "%-16s %d stages, %.2e R^2/D: wall %6.2f steps %6.1f stages; processor %6.2f steps %6.1f stages; coordination %.2f\n", name,
        run.time_step.stages, run.time_step.time_step / run.time_step.diffusion_time, work / wall.count(),
        run.time_step.stages * work / wall.count(), work / busy, run.time_step.stages * work / busy, run.coordination);
    return run;
}

}  // namespace

int main(int argc, char** argv) {
    const auto argument = [&](int place, double otherwise) { return argc > place ? std::atof(argv[place]) : otherwise; };
    SuspensionOptions suspension;
    suspension.volume_fraction = 0.4;
    suspension.radii = Eigen::VectorXd::Constant(static_cast<Index>(argument(1, 8000)), radius);
    omp_set_num_threads(static_cast<int>(argument(4, 1)));
    const double steps = argument(3, 2000);
    const BrownianRun stabilised = timed_run("stabilised", place_suspension(suspension), 0.05, steps);
    const BrownianRun early = timed_run("first contacts", stabilised.packing, 1e-3 * argument(2, 0), steps);
    timed_run("network", early.packing, 1e-3 * argument(2, 0), steps);
    return 0;
}
