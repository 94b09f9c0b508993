// SPDX-License-Identifier: GPL-3.0-or-later
// What several images of the same particles, taken one after the other, show of the errors of localisation, whatever the structure.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A quantity that differs between two images.
enum class ImageQuantity { plane, axis, unmatched };

struct RepeatedImages {
    /// In the order of the differences: standard deviations of the centres in the plane x-y and along z over the diameter, from the
    /// medians of the displacements as if these were normal, which a few wrong matches do not change; share of the centres of an
    /// image that the next one does not have.
    std::array<double, 3> values{};
    double centres = 0;  ///< that are compared: as many independent pairs of them
};

/// Centres with independent normal errors [m].
Eigen::Matrix3Xd with_errors(const Eigen::Matrix3Xd& centres, double sigma_plane, double sigma_axis, std::uint64_t seed,
                             std::uint64_t draw);

/// Compares each image with the next. A centre is found again where the nearest one of the other image lies within half a diameter
/// and has it for its own nearest, a drift of the whole taken out. Centres within half a diameter of the faces of the box around
/// all are not counted. Throws InputError when two images are the same.
/// @param images 3 x N each [m].
/// @param name of the table.
RepeatedImages compare_images(const std::vector<Eigen::Matrix3Xd>& images, double diameter, const std::string& name);

/// The same of pairs of images of a periodic structure with independent normal errors [m] from a fixed seed.
RepeatedImages images_of_structure(const Packing& packing, double sigma_plane, double sigma_axis);

/// Standard error of a difference of this value in so many centres.
double error_of(ImageQuantity quantity, double value, double centres);

}  // namespace coagula::diagnose
