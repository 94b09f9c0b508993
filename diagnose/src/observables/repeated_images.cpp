// SPDX-License-Identifier: GPL-3.0-or-later
#include "repeated_images.hpp"

#include "data/median.hpp"
#include "data/normal_number.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr double match_reach = 0.5;  ///< over the diameter
constexpr std::uint64_t image_seed = 20121;
constexpr double least_centres_drawn = 10000;  ///< of simulated images, so that their own scatter does not count
/// Median of |x| of a normal variable over its standard deviation, and the standard error of that estimate times sqrt(n) over the
/// deviation.
constexpr double median_of_normal = 0.674490;
constexpr double error_of_median = 1.16635;
constexpr double least_error = 1e-4;  ///< of a displacement over the diameter: digits of coordinates

/// Displacements of the centres that are found again.
struct Matches {
    std::vector<Index> first;
    Eigen::Matrix3Xd displacement;
};

Matches match(const Cell& cell, const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second, double reach) {
    Packing both{cell, Eigen::Matrix3Xd(3, first.cols() + second.cols()), {}};
    both.positions << first, second;
    both.radii = Eigen::VectorXd::Constant(both.size(), reach);
    const ContactNetwork pairs = find_pairs(both, reach);
    std::vector<Index> nearest(static_cast<std::size_t>(both.size()), -1);
    const auto across = [&](Index pair) { return pairs.ends(0, pair) < first.cols() && pairs.ends(1, pair) >= first.cols(); };
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        for (int end = 0; end < 2 && across(pair); ++end) {
            Index& best = nearest[static_cast<std::size_t>(pairs.ends(end, pair))];
            if (best < 0 || pairs.branch.col(pair).squaredNorm() < pairs.branch.col(best).squaredNorm()) {
                best = pair;
            }
        }
    }
    Matches found;
    found.displacement.resize(3, first.cols());
    for (Index centre = 0; centre < first.cols(); ++centre) {
        const Index pair = nearest[static_cast<std::size_t>(centre)];
        if (pair >= 0 && nearest[static_cast<std::size_t>(pairs.ends(1, pair))] == pair) {
            found.displacement.col(static_cast<Index>(found.first.size())) = pairs.branch.col(pair);
            found.first.push_back(centre);
        }
    }
    found.displacement.conservativeResize(3, static_cast<Index>(found.first.size()));
    return found;
}

/// Median of every component of the displacements.
Eigen::Vector3d median_displacement(const Matches& matches) {
    Eigen::Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::VectorXd row = matches.displacement.row(axis);
        std::vector<double> values(row.begin(), row.end());
        middle[axis] = median(values);
    }
    return middle;
}

Eigen::Matrix3Xd without_drift(const Cell& cell, const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second, double reach) {
    return second.colwise() - median_displacement(match(cell, first, second, reach));
}

/// Collects what pairs of images show.
class Differences {
public:
    explicit Differences(double diameter) : diameter_(diameter) {}

    /// @param counts whether a centre of the first image is counted.
    template <class Counts>
    void add(const Cell& cell, const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second, const Counts& counts) {
        const double reach = match_reach * diameter_;
        const Matches matches = match(cell, first, cell.is_periodic() ? second : without_drift(cell, first, second, reach), reach);
        for (Index centre = 0; centre < first.cols(); ++centre) {
            centres_ += counts(first.col(centre)) ? 1 : 0;
        }
        for (std::size_t k = 0; k < matches.first.size(); ++k) {
            if (!counts(first.col(matches.first[k]))) {
                continue;
            }
            const Eigen::Vector3d moved = matches.displacement.col(static_cast<Index>(k));
            ++matched_;
            plane_.insert(plane_.end(), {std::abs(moved.x()), std::abs(moved.y())});
            axis_.push_back(std::abs(moved.z()));
        }
    }

    double centres() const { return centres_; }

    RepeatedImages result() {
        const double scale = 1 / (std::numbers::sqrt2 * median_of_normal * diameter_);
        return {{scale * median(plane_), scale * median(axis_), centres_ > 0 ? 1 - matched_ / centres_ : 0.0}, centres_};
    }

private:
    double diameter_;
    double centres_ = 0;
    double matched_ = 0;
    std::vector<double> plane_;
    std::vector<double> axis_;
};

}  // namespace

Eigen::Matrix3Xd with_errors(const Eigen::Matrix3Xd& centres, double sigma_plane, double sigma_axis, std::uint64_t seed,
                             std::uint64_t draw) {
    Eigen::Matrix3Xd seen = centres;
    for (Index centre = 0; centre < seen.cols(); ++centre) {
        const auto number = 3 * static_cast<std::uint64_t>(centre);
        seen.col(centre) +=
            Eigen::Vector3d(sigma_plane * normal_number(seed, draw, number), sigma_plane * normal_number(seed, draw, number + 1),
                            sigma_axis * normal_number(seed, draw, number + 2));
    }
    return seen;
}

RepeatedImages compare_images(const std::vector<Eigen::Matrix3Xd>& images, double diameter, const std::string& name) {
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d high = -low;
    for (const Eigen::Matrix3Xd& image : images) {
        low = low.min(image.rowwise().minCoeff().array());
        high = high.max(image.rowwise().maxCoeff().array());
    }
    const double margin = match_reach * diameter;
    const auto is_inside = [&](const Eigen::Vector3d& centre) {
        return (centre.array() > low + margin).all() && (centre.array() < high - margin).all();
    };
    const Cell cell = Cell::open(low.matrix(), (high - low).matrix());
    Differences differences(diameter);
    for (std::size_t k = 0; k + 1 < images.size(); ++k) {
        if (images[k].cols() == images[k + 1].cols() && images[k] == images[k + 1]) {
            throw InputError(name +
                             ": two images one after the other have the same coordinates; column 'frame' numbers images of the "
                             "same particles that were taken and evaluated one by one");
        }
        differences.add(cell, images[k], images[k + 1], is_inside);
    }
    RepeatedImages found = differences.result();
    // Differences of neighbours in a series share an image (von Neumann's mean square successive difference).
    const auto steps = static_cast<double>(images.size()) - 1;
    found.centres *= 2 * steps / (3 * steps - 1);
    return found;
}

RepeatedImages images_of_structure(const Packing& packing, double sigma_plane, double sigma_axis) {
    Differences differences(2 * mean_radius(packing));
    const auto image = [&](std::uint64_t draw) {
        return with_errors(packing.positions, sigma_plane, sigma_axis, image_seed, draw);
    };
    for (std::uint64_t draw = 0; differences.centres() < least_centres_drawn; draw += 2) {
        differences.add(packing.cell, image(draw), image(draw + 1), [](const auto&) { return true; });
    }
    return differences.result();
}

double error_of(ImageQuantity quantity, double value, double centres) {
    if (quantity == ImageQuantity::unmatched) {
        return std::sqrt(std::max(value * (1 - value), 1 / centres) / centres);
    }
    const double components = quantity == ImageQuantity::plane ? 2 : 1;
    return std::max(error_of_median * value / std::sqrt(components * centres), least_error);
}

}  // namespace coagula::diagnose
