// How many bonds still break, and what is lost, when the strain of a row is applied once more: explicit amplitude sweeps in which
// every strain is applied several times.
// Usage: bench_repeated_strain [N [structures [times]]]
#include <coagula/common/contact_network.hpp>

#include "breaking_structures.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

namespace {

using namespace coagula;

/// Amplitudes over the critical strain.
const std::vector<double> loads{1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16, 32};

/// Broken bonds and G'' over the storage modulus at vanishing strain, of every oscillation, in rows.
Eigen::MatrixX2d sweep(const Packing& packing, int times) {
    mechanics::RheometerOptions run = breaking_sweep(loads.back());
    run.damping = 0.7;
    run.course.assign(2, 1e-3);
    for (const double load : loads) {
        run.course.insert(run.course.end(), static_cast<std::size_t>(times), load / loads.back());
    }
    run.oscillations = static_cast<int>(run.course.size());
    const auto all = mechanics::run_rheometer(packing, find_contacts(packing, 0.01), run, {mechanics::ShearOrientation{}})
                         .runs.front()
                         .oscillations;
    Eigen::MatrixX2d found(static_cast<Index>(all.size()) - 2, 2);
    for (Index k = 0; k < found.rows(); ++k) {
        const mechanics::Oscillation& one = all[static_cast<std::size_t>(k) + 2];
        found.row(k) << static_cast<double>(one.broken_bonds), one.fundamental_loss / all[1].fundamental_storage;
    }
    return found;
}

void run(int argc, char** argv) {
    const Index particles = argc > 1 ? std::atol(argv[1]) : 400;
    const int structures = argc > 2 ? std::atoi(argv[2]) : 6;
    const int times = argc > 3 ? std::max(1, std::atoi(argv[3])) : 3;
    Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(times * static_cast<Index>(loads.size()), 2);
    for (int k = 0; k < structures; ++k) {
        mean += sweep(structure(particles, static_cast<std::uint64_t>(k) + 1), times) / structures;
    }
    std::printf("%d structures of %ld particles; strain over the critical one; broken bonds and G''/G each time\n", structures,
                static_cast<long>(particles));
    for (std::size_t load = 0; load < loads.size(); ++load) {
        std::printf("%5.1f", loads[load]);
        for (Index k = 0; k < times; ++k) {
            const Index row = static_cast<Index>(load) * times + k;
            std::printf("   %5.1f %6.4f", mean(row, 0), mean(row, 1));
        }
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_repeated_strain: %s\n", error.what());
        return 2;
    }
}
