// SPDX-License-Identifier: GPL-3.0-or-later
#include "imaged_pores.hpp"

#include "observables/repeated_images.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coagula::diagnose {

namespace {

constexpr std::uint64_t seed_of_pores = 20122;
constexpr std::uint64_t missed_seed = 20123;
constexpr std::uint64_t place_seed = 20124;

/// All particles in a random order, of which an image misses the first.
std::vector<Index> random_order(Index count, std::uint64_t draw) {
    std::vector<double> number(static_cast<std::size_t>(count));
    std::vector<Index> order(number.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t k = 0; k < number.size(); ++k) {
        number[k] = random_uniform(missed_seed, RandomPurpose::diagnosis, draw, k)[0];
    }
    std::sort(order.begin(), order.end(), [&](Index one, Index other) {
        return number[static_cast<std::size_t>(one)] < number[static_cast<std::size_t>(other)];
    });
    return order;
}

bool is_free(const Packing& packing, Index centres, const Eigen::Vector3d& place, double distance) {
    for (Index centre = 0; centre < centres; ++centre) {
        if (packing.cell.minimum_image(packing.positions.col(centre) - place).norm() < distance) {
            return false;
        }
    }
    return true;
}

void add_false_centres(Packing& packing, Index count, double radius, std::uint64_t draw) {
    constexpr std::uint64_t most_tries = 1000000;
    Index centres = packing.size();
    packing.positions.conservativeResize(3, centres + count);
    for (std::uint64_t tries = 0; centres < packing.positions.cols(); ++tries) {
        require(tries < most_tries, "there is no room for false centres between the particles");
        const Eigen::Vector3d u = random_uniform(place_seed, RandomPurpose::diagnosis, draw, tries);
        const Eigen::Vector3d place = packing.cell.origin() + packing.cell.lengths().cwiseProduct(u);
        if (is_free(packing, centres, place, radius)) {
            packing.positions.col(centres++) = place;
        }
    }
    packing.radii.conservativeResize(centres);
    packing.radii.tail(count).setConstant(radius);
}

}  // namespace

Packing as_imaged(const Packing& packing, const ImageErrors& errors, std::uint64_t draw) {
    const Eigen::Matrix3Xd found = with_errors(packing.positions, errors.plane, errors.axis, seed_of_pores, draw);
    const std::vector<Index> order = random_order(packing.size(), draw);
    const auto missed = static_cast<Index>(std::lround(errors.missed * static_cast<double>(packing.size())));
    const Index seen = packing.size() - missed;
    Packing image{packing.cell, Eigen::Matrix3Xd(3, seen), Eigen::VectorXd(seen)};
    for (Index k = 0; k < seen; ++k) {
        const Index particle = order[static_cast<std::size_t>(missed + k)];
        image.positions.col(k) = packing.cell.wrap(found.col(particle));
        image.radii[k] = packing.radii[particle];
    }
    const double false_over_true = errors.wrong / (1 - errors.wrong);
    add_false_centres(image, static_cast<Index>(std::lround(false_over_true * static_cast<double>(seen))), mean_radius(packing),
                      draw);
    return image;
}

}  // namespace coagula::diagnose
