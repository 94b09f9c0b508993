#include "imaged_pores.hpp"

#include "interpolation.hpp"
#include "observables/repeated_images.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/random.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace coagula::diagnose {

namespace {

constexpr std::uint64_t seed_of_pores = 20122;
constexpr std::uint64_t missed_seed = 20123;
constexpr std::uint64_t place_seed = 20124;
constexpr Index least_particles_of_pores = 1000;  ///< so that what is drawn scatters less than the structures
constexpr Axis pore_error_axis{0.02, 0.9, 5};     ///< standard deviation over the diameter
constexpr LinearAxis share_axis{0, 0.1, 5};
constexpr int radii = 201;
constexpr double largest_pore = 4;  ///< in particle radii, where a curve ends; it is compared down to 0.01

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

/// Mean over the structures, for errors in the plane and along z over the diameter and the shares of missed and of false centres.
const PoreCurve& Simulator::imaged_pores(const std::array<double, 4>& errors) {
    PoreCurve& pores = imaged_pores_[errors];
    if (pores.probability.empty()) {
        pores.largest = largest_pore * radius_;
        const double diameter = 2 * radius_;
        const ImageErrors image{diameter * errors[0], diameter * errors[1], errors[2], errors[3]};
        pores.probability =
            mean_over_structures("imaged pores", radii, {errors.begin(), errors.end()}, [&](const Packing& structure) {
                progress_.update("simulating", 0.0, "pores in images");
                const Index draws = 1 + least_particles_of_pores / structure.size();
                std::vector<double> mean(radii, 0.0);
                for (Index draw = 0; draw < draws; ++draw) {
                    const PoreCurve one = measured_pores(as_imaged(structure, image, static_cast<std::uint64_t>(draw)));
                    for (std::size_t k = 0; k < mean.size(); ++k) {
                        mean[k] += one.at(pores.largest * static_cast<double>(k) / (radii - 1)) / static_cast<double>(draws);
                    }
                }
                return mean;
            });
    }
    return pores;
}

/// What the errors change in the mean of the structures, `probability`. Those of the places, missed and false centres add up,
/// unless they are to act together.
double Simulator::change_in_images(const Settings& settings, double pore_radius, double probability, bool exact) {
    const double plane = settings.localisation_plane / (2 * radius_);
    const double axis = settings.localisation_axis / (2 * radius_);
    const double missed = settings.missed_share;
    const double wrong = settings.false_share;
    const auto changed_by = [&](const std::array<double, 4>& errors) { return imaged_pores(errors).at(pore_radius) - probability; };
    if (plane == 0 && axis == 0 && missed == 0 && wrong == 0) {
        return 0;
    }
    if (exact) {
        return changed_by({plane, axis, missed, wrong});
    }
    double change = 0;
    if (plane > 0 || axis > 0) {
        change += interpolate_nodes(pore_error_axis, plane, axis, [&](int i, int j) {
            return changed_by({pore_error_axis.node(i), pore_error_axis.node(j), 0, 0});
        });
    }
    const auto at_share = [&](double share, const auto& errors) {
        return share == 0 ? 0.0 : interpolate_nodes(share_axis, share, [&](int k) {
            return k == 0 ? 0.0 : changed_by(errors(share_axis.node(k)));
        });
    };
    change += at_share(missed, [](double share) { return std::array<double, 4>{0, 0, share, 0}; });
    change += at_share(wrong, [](double share) { return std::array<double, 4>{0, 0, 0, share}; });
    return change;
}

}  // namespace coagula::diagnose
