// SPDX-License-Identifier: GPL-3.0-or-later
// What friction between particles whose bond has broken does to an amplitude sweep up and down: explicit runs of the same
// structures with several coefficients of friction. More steps show what the rate of the runs costs.
// Usage: bench_friction [N [structures [steps per oscillation [friction ...]]]]
#include <coagula/common/contact_network.hpp>

#include "breaking_structures.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <limits>
#include <vector>

namespace {

using namespace coagula;

/// Amplitudes over the critical strain.
const std::vector<double> loads{1.5, 2, 2.5, 3, 3.5, 4, 4.75, 5.5, 6.5, 8, 5.5, 3.5, 2, 1};

/// G* of every amplitude over the storage modulus at vanishing strain, less the loss there.
Eigen::VectorXcd sweep(const Packing& packing, double friction, int steps) {
    mechanics::RheometerOptions run = breaking_sweep(8);
    run.model.friction = friction;
    run.oscillations = static_cast<int>(loads.size()) + 2;
    run.steps_per_oscillation = steps;
    run.course.assign(2, {1e-3});
    for (const double load : loads) {
        run.course.push_back({load / 8});
    }
    const ContactNetwork bonds = find_contacts(packing, 0.01);
    const auto oscillations =
        mechanics::run_rheometer(packing, bonds, run, {mechanics::ShearOrientation{}}).runs.front().oscillations;
    Eigen::VectorXcd moduli(static_cast<Index>(loads.size()));
    for (Index k = 0; k < moduli.size(); ++k) {
        const mechanics::Oscillation& one = oscillations[static_cast<std::size_t>(k) + 2];
        moduli[k] = std::complex<double>(one.fundamental_storage, one.fundamental_loss - oscillations[1].fundamental_loss) /
                    oscillations[1].fundamental_storage;
    }
    return moduli;
}

/// Mean and standard deviation of rows over the structures.
void print(const char* name, double friction, const Eigen::MatrixXd& values) {
    const Eigen::RowVectorXd mean = values.colwise().mean();
    const Eigen::RowVectorXd deviation =
        ((values.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(values.rows() - 1)).cwiseSqrt();
    std::printf("%-22s %.1f ", name, friction);
    for (Index k = 0; k < mean.size(); ++k) {
        std::printf(" %6.3f+-%.3f", mean[k], deviation[k]);
    }
    std::printf("\n");
}

constexpr Index upwards = 10;  ///< loads

/// G' / G of a sweep at strains over those of the rows' loads, from one at these: between the rows on the way up, in proportion to
/// the largest load on the way down.
Eigen::VectorXd stretched(const Eigen::VectorXd& storage, double stretch) {
    const auto at = [&](double load) {
        Index above = 0;
        while (above + 1 < upwards && loads[static_cast<std::size_t>(above)] < load) {
            ++above;
        }
        const double from = above == 0 ? 0.0 : loads[static_cast<std::size_t>(above) - 1];
        const double below = above == 0 ? 1.0 : storage[above - 1];
        const double way = (load - from) / (loads[static_cast<std::size_t>(above)] - from);
        return below + std::min(way, 1.0) * (storage[above] - below);
    };
    Eigen::VectorXd moved = storage * at(8 / stretch) / storage[upwards - 1];
    for (Index k = 0; k < upwards; ++k) {
        moved[k] = at(loads[static_cast<std::size_t>(k)] / stretch);
    }
    return moved;
}

/// Smallest rms difference of G' / G between a structure and the mean of the others whose critical strain is fitted, mean over the
/// structures.
double misfit(const Eigen::MatrixXd& truth, const Eigen::MatrixXd& model) {
    double sum = 0;
    for (Index k = 0; k < truth.rows(); ++k) {
        const Eigen::VectorXd others = (model.colwise().sum() - model.row(k)).transpose() / static_cast<double>(model.rows() - 1);
        double best = std::numeric_limits<double>::max();
        for (double stretch = 0.5; stretch < 2; stretch *= 1.005) {
            const Eigen::VectorXd difference = stretched(others, stretch) - truth.row(k).transpose();
            best = std::min(best, std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())));
        }
        sum += best;
    }
    return sum / static_cast<double>(truth.rows());
}

void run(int argc, char** argv) {
    const Index particles = argc > 1 ? std::atol(argv[1]) : 500;
    const Index structures = argc > 2 ? std::max(2L, std::atol(argv[2])) : 6;
    const int steps = argc > 3 ? std::atoi(argv[3]) : 6000;
    std::vector<double> frictions{0, 0.3, 0.8};
    if (argc > 4) {
        frictions.clear();
        std::transform(argv + 4, argv + argc, std::back_inserter(frictions), [](const char* word) { return std::atof(word); });
    }
    std::vector<Eigen::MatrixXcd> moduli(frictions.size(), Eigen::MatrixXcd(structures, static_cast<Index>(loads.size())));
    for (Index k = 0; k < structures; ++k) {
        const Packing packing = structure(particles, static_cast<std::uint64_t>(101 + k));
        for (std::size_t mu = 0; mu < frictions.size(); ++mu) {
            moduli[mu].row(k) = sweep(packing, frictions[mu] > 0 ? frictions[mu] : unset, steps).transpose();
        }
    }
    std::printf("mean +- standard deviation over %ld structures; amplitude over critical strain\n%26s", structures, "");
    for (const double load : loads) {
        std::printf(" %13.2f", load);
    }
    std::printf("\n");
    for (std::size_t mu = 0; mu < frictions.size(); ++mu) {
        print("G' / G, friction", frictions[mu], moduli[mu].real());
        print("G'' / G, friction", frictions[mu], moduli[mu].imag());
    }
    for (std::size_t mu = 1; mu < frictions.size(); ++mu) {
        print("G' / G, change by", frictions[mu], (moduli[mu] - moduli[0]).real());
        print("G'' / G, change by", frictions[mu], (moduli[mu] - moduli[0]).imag());
    }
    for (std::size_t truth = 0; truth < frictions.size(); ++truth) {
        for (std::size_t model = 0; model < frictions.size(); ++model) {
            std::printf("structures with friction %.1f by the others with friction %.1f, critical strain fitted: rms G' / G %.3f\n",
                        frictions[truth], frictions[model], misfit(moduli[truth].real(), moduli[model].real()));
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(argc, argv);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_friction: %s\n", error.what());
        return 1;
    }
    return 0;
}
