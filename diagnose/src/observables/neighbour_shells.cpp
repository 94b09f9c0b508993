// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbour_shells.hpp"

#include "repeated_images.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/dense.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr std::uint64_t seed_of_shells = 20120;
constexpr Index least_particles_of_shells = 4000;  ///< so that the errors that are drawn do not count beside those of an image

constexpr double least_variance = 10;
constexpr int shell_of_contact = 4;
constexpr Index axes = 3;

/// The shell of a neighbour at this place; -1 beyond them.
int shell_at(const Eigen::Vector3d& branch, double diameter) {
    const double distance = branch.norm();
    const int shell = static_cast<int>(std::floor((distance / diameter - first_shell) / shell_width));
    const int first = 2 * std::abs(branch.z()) < distance ? 0 : shells_of_direction;
    return shell >= 0 && shell < shells_of_direction ? first + shell : -1;
}

/// The same structure with another of its axes along z; `turns` = 0 leaves it.
Packing turned(const Packing& packing, Index turns) {
    const std::array<Index, 3> rows{turns % 3, (turns + 1) % 3, (turns + 2) % 3};
    Packing other = packing;
    other.cell = Cell::periodic(packing.cell.lengths()(rows));
    other.positions = packing.positions(rows, Eigen::all);
    return other;
}

/// Pairs of a periodic structure within the reach, and the neighbours of every particle, shells x particles.
struct NearPairs {
    ContactNetwork pairs;
    Eigen::MatrixXd counts;
};

NearPairs neighbours_of(const Packing& packing, double diameter) {
    Packing seen = packing;
    seen.radii.setConstant(diameter / 2);  // the shells are distances of centres, whatever the sizes
    NearPairs all{find_contacts(seen, shell_reach - 1), Eigen::MatrixXd::Zero(shell_count, packing.size())};
    for (Index pair = 0; pair < all.pairs.size(); ++pair) {
        if (const int shell = shell_at(all.pairs.branch.col(pair), diameter); shell >= 0) {
            all.counts(shell, all.pairs.ends(0, pair)) += 1;
            all.counts(shell, all.pairs.ends(1, pair)) += 1;
        }
    }
    return all;
}

/// Standard errors of one particle from the spread over that of independent pairs, of which a share is counted from both ends,
/// as far as it is above `least`. An empty shell stays so.
Eigen::MatrixXd errors_above(const std::vector<double>& spread, double mutual, double least) {
    const Eigen::Map<const Eigen::MatrixXd> all(spread.data(), shell_count, 1 + 2 * shell_count);
    const Eigen::VectorXd deviation = ((1 + mutual) * all.col(0)).cwiseSqrt();
    const Eigen::VectorXd inverse = (deviation.array() > 0).select(deviation.cwiseInverse(), 0);
    const Eigen::MatrixXd covariance = all.middleCols<shell_count>(1) + mutual * all.rightCols<shell_count>();
    const dense::SymmetricModes modes(inverse.asDiagonal() * covariance * inverse.asDiagonal());
    const Eigen::VectorXd above = (modes.values.array() - least).max(0).sqrt();
    const Index some = (above.array() > 0).count();
    return deviation.asDiagonal() * (modes.vectors * above.asDiagonal()).rightCols(some);
}

}  // namespace

NeighbourShells shells_of_points(const Eigen::Matrix3Xd& positions, double diameter) {
    const Eigen::Array3d low = positions.rowwise().minCoeff().array() + shell_reach * diameter;
    const Eigen::Array3d high = positions.rowwise().maxCoeff().array() - shell_reach * diameter;
    const auto is_centre = [&](Index point) {
        return (positions.col(point).array() >= low).all() && (positions.col(point).array() <= high).all();
    };
    NeighbourShells shells;
    Eigen::ArrayXd neighbours = Eigen::ArrayXd::Zero(shell_count);
    Eigen::ArrayXd mutual = neighbours;
    for (Index centre = 0; centre < positions.cols(); ++centre) {
        if (!is_centre(centre)) {
            continue;
        }
        ++shells.centres;
        for (Index other = 0; other < positions.cols(); ++other) {
            const int shell = other == centre ? -1 : shell_at(positions.col(other) - positions.col(centre), diameter);
            if (shell >= 0) {
                neighbours[shell] += 1;
                mutual[shell] += is_centre(other) ? 1 : 0;
            }
        }
    }
    const auto centres = static_cast<double>(std::max<Index>(1, shells.centres));
    const Eigen::ArrayXd mean = neighbours / centres;
    const Eigen::ArrayXd variances = neighbours + mutual;  // a pair of centres is counted twice
    shells.mean.assign(mean.begin(), mean.end());
    shells.variances.assign(variances.begin(), variances.end());
    shells.mutual = mutual.sum() / std::max(1.0, neighbours.sum());
    return shells;
}

std::vector<ShellGroup> groups_of_shells(const std::vector<double>& variances) {
    std::vector<ShellGroup> groups;
    for (int shell = 0; shell < shell_count; ++shell) {
        const int place = shell % shells_of_direction;
        const bool begins = place == 0 || place == shell_of_contact || groups.back().variance >= least_variance;
        if (begins) {
            groups.push_back({shell, 0, 0});
        }
        ++groups.back().count;
        groups.back().variance += variances[static_cast<std::size_t>(shell)];
    }
    return groups;
}

double error_of_count(double variance) {
    return variance < least_variance ? 1 + std::sqrt(variance + 0.75) : std::sqrt(variance);
}

std::vector<double> shells_of_structure(const Packing& packing, double sigma_plane, double sigma_axis) {
    const double diameter = 2 * mean_radius(packing);
    const bool sharp = sigma_plane == 0 && sigma_axis == 0;
    const Index draws = axes * (sharp ? 1 : 1 + least_particles_of_shells / packing.size() / axes);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(shell_count);
    for (Index draw = 0; draw < draws; ++draw) {
        Packing seen = turned(packing, draw);
        seen.positions = with_errors(seen.positions, sigma_plane, sigma_axis, seed_of_shells, static_cast<std::uint64_t>(draw));
        mean += neighbours_of(seen, diameter).counts.rowwise().mean() / static_cast<double>(draws);
    }
    return {mean.begin(), mean.end()};
}

std::vector<double> spread_of_neighbours(const Packing& packing) {
    const auto particles = static_cast<double>(packing.size());
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(shell_count, 1 + 2 * shell_count);
    for (Index axis = 0; axis < axes; ++axis) {
        const auto [pairs, counts] = neighbours_of(turned(packing, axis), 2 * mean_radius(packing));
        const Eigen::VectorXd mean = counts.rowwise().mean();
        const Eigen::MatrixXd own = counts.colwise() - mean;
        Eigen::MatrixXd others = Eigen::MatrixXd::Zero(own.rows(), own.cols());
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            others.col(pairs.ends(0, pair)) += own.col(pairs.ends(1, pair));
            others.col(pairs.ends(1, pair)) += own.col(pairs.ends(0, pair));
        }
        spread.col(0) += mean / axes;
        spread.middleCols<shell_count>(1) += own * own.transpose() / (axes * particles);
        spread.rightCols<shell_count>() += own * others.transpose() / (axes * particles);
    }
    return {spread.reshaped().begin(), spread.reshaped().end()};
}

Eigen::MatrixXd errors_of_structures(const std::vector<double>& spread, double particles) {
    return errors_above(spread, 1, 0) / std::sqrt(particles);
}

Eigen::MatrixXd errors_of_density(const std::vector<double>& spread, double centres, double mutual) {
    return errors_above(spread, mutual, 1) / std::sqrt(centres);
}

std::vector<double> shells_about_free_places(const Packing& packing) {
    constexpr int places = 5000;
    constexpr std::uint64_t most_tried = 100 * std::uint64_t{places};
    constexpr double nearest = 0.5;
    const double diameter = 2 * mean_radius(packing);
    const Eigen::Array3d box = packing.cell.lengths().array();
    std::vector<double> mean(shell_count, 0);
    int free = 0;
    for (std::uint64_t number = 0; free < places && number < most_tried; ++number) {
        const auto u = random_uniform(seed_of_shells, RandomPurpose::diagnosis, 1, number);
        const Eigen::Array3d place = box * Eigen::Array3d(u[0], u[1], u[2]);
        std::vector<int> shells;
        bool taken = false;
        for (Index particle = 0; particle < packing.size() && !taken; ++particle) {
            Eigen::Array3d branch = packing.positions.col(particle).array() - place;
            branch -= box * (branch / box).round();
            taken = branch.matrix().norm() < nearest * diameter;
            if (const int shell = shell_at(branch, diameter); shell >= 0) {
                shells.push_back(shell);
            }
        }
        if (!taken) {
            ++free;
            for (const int shell : shells) {
                mean[static_cast<std::size_t>(shell)] += 1;
            }
        }
    }
    for (std::size_t shell = 0; shell < shells_of_direction; ++shell) {
        const double both = mean[shell] + mean[shells_of_direction + shell];
        mean[shell] = mean[shells_of_direction + shell] = 0.5 * both / std::max(1, free);
    }
    mean.push_back(static_cast<double>(packing.size()) * std::pow(diameter, 3) / box.prod());
    return mean;
}

double shell_volume(std::size_t shell) {
    const double inner = inner_end(shell);
    return 2 * std::numbers::pi / 3 * (std::pow(inner + shell_width, 3) - std::pow(inner, 3));
}

}  // namespace coagula::diagnose
