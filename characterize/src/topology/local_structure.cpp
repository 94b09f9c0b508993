// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/local_structure.hpp>

#include <coagula/common/contact_network.hpp>

#include "geometry/nearest.hpp"
#include "sample/averaged_particles.hpp"

#include <Eigen/Geometry>

#include <numbers>

namespace coagula::characterize {

namespace {

constexpr double pi = std::numbers::pi;

/// Unit vectors from a particle to those it touches.
std::vector<Eigen::Vector3d> contact_directions(const ContactNetwork& contacts, const ContactsByParticle& groups, Index particle) {
    std::vector<Eigen::Vector3d> directions;
    const auto row = static_cast<std::size_t>(particle);
    for (Index entry = groups.start[row]; entry < groups.start[row + 1]; ++entry) {
        const Index contact = groups.contact[static_cast<std::size_t>(entry)];
        const Eigen::Vector3d branch = contacts.branch.col(contact).normalized();
        // A contact with its own image is in the group of the particle twice, once for each of its directions.
        const bool twin = contacts.ends(0, contact) == contacts.ends(1, contact);
        const bool second = twin && entry > groups.start[row] && groups.contact[static_cast<std::size_t>(entry) - 1] == contact;
        const bool outward = contacts.ends(0, contact) == static_cast<std::int32_t>(particle) && !second;
        directions.emplace_back(outward ? branch : Eigen::Vector3d(-branch));
    }
    return directions;
}

}  // namespace

BondAngles measure_bond_angles(const Packing& packing, const BondAngleOptions& options) {
    check(packing);
    require(options.bins >= 1, "the distribution of bond angles needs at least one bin");
    const ContactNetwork contacts = find_contacts(packing, options.contact_tolerance);
    const ContactsByParticle groups = group_by_particle(contacts);
    const AveragedParticles averaged(packing);
    const double width = pi / static_cast<double>(options.bins);
    constexpr double equilateral = 65 * pi / 180;
    Eigen::MatrixXd counts = Eigen::MatrixXd::Zero(averaged.blocks, options.bins);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(averaged.blocks);
    BlockSums angles(averaged.blocks), narrow(averaged.blocks);
    for (std::size_t k = 0; k < averaged.particles.size(); ++k) {
        const std::vector<Eigen::Vector3d> directions = contact_directions(contacts, groups, averaged.particles[k]);
        const int block = averaged.block[k];
        for (std::size_t first = 0; first < directions.size(); ++first) {
            for (std::size_t second = first + 1; second < directions.size(); ++second) {
                const double angle =
                    std::atan2(directions[first].cross(directions[second]).norm(), directions[first].dot(directions[second]));
                counts(block, std::min(options.bins - 1, static_cast<Index>(angle / width))) += 1;
                all[block] += 1;
                angles.add(block, angle);
                narrow.add(block, angle < equilateral ? 1 : 0);
            }
        }
    }
    BondAngles result;
    result.angle = Eigen::VectorXd::LinSpaced(options.bins, width / 2, pi - width / 2);
    result.density = result.density_stderr = Eigen::VectorXd::Zero(options.bins);
    result.angles = static_cast<Index>(all.sum());
    if (result.angles == 0) {
        return result;
    }
    for (Index bin = 0; bin < options.bins; ++bin) {
        result.density[bin] = counts.col(bin).sum() / (all.sum() * width);
        result.density_stderr[bin] = ratio_stderr(counts.col(bin), all) / width;
    }
    result.mean = angles.mean();
    result.mean_stderr = angles.mean_stderr();
    result.below_equilateral = narrow.mean();
    result.below_equilateral_stderr = narrow.mean_stderr();
    return result;
}

namespace {

/// @param first distance to the nearest particle, of each averaged particle.
void add_errors_of_nearest(const Eigen::VectorXd& first, const AveragedParticles& averaged, NeighbourDistances& result) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3, averaged.blocks);
    Eigen::VectorXd smallest = Eigen::VectorXd::Constant(averaged.blocks, std::numeric_limits<double>::infinity());
    for (Index k = 0; k < first.size(); ++k) {
        const int block = averaged.block[static_cast<std::size_t>(k)];
        sums.col(block) += Eigen::Vector3d(1, first[k], first[k] * first[k]);
        smallest[block] = std::min(smallest[block], first[k]);
    }
    result.smallest_stderr = extreme_error(smallest);
    result.spread_stderr = block_errors(sums, [](const Eigen::VectorXd& sum) {
        const double mean = sum[1] / sum[0];
        return Eigen::VectorXd::Constant(1, std::sqrt(std::max(0.0, sum[2] / sum[0] - mean * mean)));
    })[0];
}

}  // namespace

NeighbourDistances measure_neighbour_distances(const Packing& packing, const NeighbourDistanceOptions& options) {
    check(packing);
    require(options.neighbours >= 1 && options.neighbours <= 100 && options.bins >= 1,
            "the distances of neighbours need 1 to 100 neighbours and at least one bin");
    require(packing.cell.is_periodic() || packing.size() > options.neighbours,
            "the packing is open and has " + std::to_string(packing.size()) + " particles, too few for the distance to neighbour " +
                std::to_string(options.neighbours));
    const auto nearest = nearest_neighbours(packing, options.neighbours);
    const AveragedParticles averaged(packing);
    std::vector<BlockSums> sums(static_cast<std::size_t>(options.neighbours), BlockSums(averaged.blocks));
    BlockSums gaps(averaged.blocks);
    Eigen::VectorXd first(static_cast<Index>(averaged.particles.size()));
    for (std::size_t k = 0; k < averaged.particles.size(); ++k) {
        const Index i = averaged.particles[k];
        const auto& neighbours = nearest[static_cast<std::size_t>(i)];
        first[static_cast<Index>(k)] = std::sqrt(neighbours.front().squared_distance);
        double gap = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < neighbours.size(); ++n) {
            const double distance = std::sqrt(neighbours[n].squared_distance);
            sums[n].add(averaged.block[k], distance);
            gap = std::min(gap, distance - packing.radii[i] - packing.radii[neighbours[n].particle]);
        }
        gaps.add(averaged.block[k], gap);
    }
    NeighbourDistances result;
    result.mean.resize(options.neighbours);
    result.mean_stderr.resize(options.neighbours);
    for (Index n = 0; n < options.neighbours; ++n) {
        result.mean[n] = sums[static_cast<std::size_t>(n)].mean();
        result.mean_stderr[n] = sums[static_cast<std::size_t>(n)].mean_stderr();
    }
    const double width = first.maxCoeff() / static_cast<double>(options.bins);
    result.distance = Eigen::VectorXd::LinSpaced(options.bins, width / 2, first.maxCoeff() - width / 2);
    result.density = Eigen::VectorXd::Zero(options.bins);
    for (const double distance : first) {
        result.density[std::min(options.bins - 1, static_cast<Index>(distance / width))] +=
            1 / (width * static_cast<double>(first.size()));
    }
    result.smallest = first.minCoeff();
    result.spread = std::sqrt((first.array() - first.mean()).square().mean());
    add_errors_of_nearest(first, averaged, result);
    result.mean_gap = gaps.mean();
    result.mean_gap_stderr = gaps.mean_stderr();
    return result;
}

}  // namespace coagula::characterize
