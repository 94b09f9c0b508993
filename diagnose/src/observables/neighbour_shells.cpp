#include "neighbour_shells.hpp"

#include "repeated_images.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr std::uint64_t seed_of_shells = 20120;
constexpr Index least_particles_of_shells = 4000;  ///< so that the errors that are drawn do not count beside those of an image

/// The shell of a distance over the diameter; -1 beyond them.
int shell_at(double distance) {
    const int shell = static_cast<int>(std::floor((distance - first_shell) / shell_width));
    return shell >= 0 && shell < shell_count ? shell : -1;
}

}  // namespace

NeighbourShells shells_of_points(const Eigen::Matrix3Xd& positions, double diameter) {
    NeighbourShells shells;
    shells.mean.assign(shell_count, 0);
    const Eigen::Array3d low = positions.rowwise().minCoeff().array() + shell_reach * diameter;
    const Eigen::Array3d high = positions.rowwise().maxCoeff().array() - shell_reach * diameter;
    for (Index centre = 0; centre < positions.cols(); ++centre) {
        const Eigen::Array3d here = positions.col(centre).array();
        if ((here < low).any() || (here > high).any()) {
            continue;
        }
        ++shells.centres;
        for (Index other = 0; other < positions.cols(); ++other) {
            const int shell = other == centre ? -1 : shell_at((positions.col(other) - positions.col(centre)).norm() / diameter);
            if (shell >= 0) {
                shells.mean[static_cast<std::size_t>(shell)] += 1;
            }
        }
    }
    const auto count = static_cast<double>(std::max<Index>(1, shells.centres));
    for (double& mean : shells.mean) {
        // Most pairs are counted from both ends.
        shells.standard_errors.push_back(std::sqrt(2 * std::max(mean, 1.0)) / count);
        mean /= count;
    }
    return shells;
}

std::vector<double> shells_of_structure(const Packing& packing, double sigma_plane, double sigma_axis) {
    const double diameter = 2 * mean_radius(packing);
    const bool sharp = sigma_plane == 0 && sigma_axis == 0;
    const Index draws = sharp ? 1 : 1 + least_particles_of_shells / packing.size();
    Packing seen = packing;
    seen.radii.setConstant(diameter / 2);  // the shells are distances of centres, whatever the sizes
    std::vector<double> mean(shell_count, 0);
    for (Index draw = 0; draw < draws; ++draw) {
        seen.positions = with_errors(packing.positions, sigma_plane, sigma_axis, seed_of_shells, static_cast<std::uint64_t>(draw));
        const ContactNetwork pairs = find_contacts(seen, shell_reach - 1);
        for (Index pair = 0; pair < pairs.size(); ++pair) {
            if (const int shell = shell_at(pairs.branch.col(pair).norm() / diameter); shell >= 0) {
                mean[static_cast<std::size_t>(shell)] += 2.0 / static_cast<double>(draws * packing.size());
            }
        }
    }
    return mean;
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
            const double distance = branch.matrix().norm() / diameter;
            taken = distance < nearest;
            if (const int shell = shell_at(distance); shell >= 0) {
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
    for (double& value : mean) {
        value /= std::max(1, free);
    }
    mean.push_back(static_cast<double>(packing.size()) * std::pow(diameter, 3) / box.prod());
    return mean;
}

double shell_volume(std::size_t shell) {
    const double inner = first_shell + shell_width * static_cast<double>(shell);
    return 4 * std::numbers::pi / 3 * (std::pow(inner + shell_width, 3) - std::pow(inner, 3));
}

}  // namespace coagula::diagnose
