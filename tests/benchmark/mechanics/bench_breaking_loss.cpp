// SPDX-License-Identifier: GPL-3.0-or-later
// What an amplitude sweep with breaking bonds loses, however it is run: every strain once; once and again while bonds hold, what
// that loses taken off; twice, what the second loses taken off.
// Usage: bench_breaking_loss [N [structures [steps per oscillation]]]
#include <coagula/common/contact_network.hpp>
#include <coagula/common/parallel.hpp>

#include "breaking_structures.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <complex>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

namespace {

using namespace coagula;

/// Amplitudes over the critical strain.
const std::vector<double> loads{1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16, 32};

enum class Again { never, holding, breaking };

/// G* of the first oscillation at every load, less the loss of the other, over the storage modulus at vanishing strain.
Eigen::RowVectorXcd sweep(const Packing& packing, Again again, int steps) {
    mechanics::RheometerOptions run = breaking_sweep(loads.back());
    run.damping = 0.7;
    run.steps_per_oscillation = steps;
    run.course.assign(2, {1e-3});
    for (const double load : loads) {
        run.course.push_back({load / loads.back()});
        if (again != Again::never) {
            run.course.push_back({load / loads.back(), again == Again::breaking});
        }
    }
    run.oscillations = static_cast<int>(run.course.size());
    const auto all = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, {mechanics::ShearOrientation{}})
                         .runs.front()
                         .oscillations;
    const std::size_t times = again == Again::never ? 1 : 2;
    Eigen::RowVectorXcd found(static_cast<Index>(loads.size()));
    for (std::size_t load = 0; load < loads.size(); ++load) {
        const mechanics::Oscillation& first = all[2 + times * load];
        const double rate = again == Again::never ? all[1].fundamental_loss : all[3 + times * load].fundamental_loss;
        found[static_cast<Index>(load)] =
            std::complex<double>(first.fundamental_storage, first.fundamental_loss - rate) / all[1].fundamental_storage;
    }
    return found;
}

void run(int argc, char** argv) {
    const Index particles = argc > 1 ? std::atol(argv[1]) : 400;
    const int structures = argc > 2 ? std::atoi(argv[2]) : 6;
    const int steps = argc > 3 ? std::atoi(argv[3]) : 6000;
    const std::vector<Again> all{Again::never, Again::holding, Again::breaking};
    std::vector<Eigen::MatrixXcd> moduli(all.size(), Eigen::MatrixXcd(structures, static_cast<Index>(loads.size())));
    run_together(static_cast<std::size_t>(structures), [&](std::size_t k) {
        const Packing packing = structure(particles, static_cast<std::uint64_t>(k) + 1);
        for (std::size_t again = 0; again < all.size(); ++again) {
            moduli[again].row(static_cast<Index>(k)) = sweep(packing, all[again], steps);
        }
    });
    std::printf(
        "%d structures of %ld particles, %d steps; strain over the critical one; G'/G and G''/G once, then holding, twice\n",
        structures, static_cast<long>(particles), steps);
    for (Index load = 0; load < moduli[0].cols(); ++load) {
        std::printf("%5.1f", loads[static_cast<std::size_t>(load)]);
        for (const Eigen::MatrixXcd& each : moduli) {
            const std::complex<double> mean = each.col(load).mean();
            std::printf("   %6.4f %7.4f", mean.real(), mean.imag());
        }
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_breaking_loss: %s\n", error.what());
        return 2;
    }
}
