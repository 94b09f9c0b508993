// SPDX-License-Identifier: GPL-3.0-or-later
#include "structure_observations.hpp"

#include "data/table_cells.hpp"
#include "neighbour_shells.hpp"
#include "repeated_images.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

namespace coagula::diagnose {

namespace {

constexpr Index fewest_centres = 20;
constexpr double rarest = 0.01;                   ///< probability; below it one largest pore decides
constexpr double unstated_error_of_curve = 2e-3;  ///< standard error of a row, sampled in a hundred thousand points

/// The images of a table of centres: one, or those that its column "frame" numbers.
std::vector<Eigen::Matrix3Xd> images_in(const Measurement& table) {
    const bool several = find_column(table, "frame") != nullptr;
    std::map<double, std::vector<Eigen::Vector3d>> centres;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const Eigen::Vector3d centre(cell(table, "x", row), cell(table, "y", row), cell(table, "z", row));
        const double frame = several ? cell(table, "frame", row) : 0;
        if (centre.allFinite() && std::isfinite(frame)) {
            centres[frame].push_back(centre);
        }
    }
    if (several && centres.empty()) {
        throw InputError(table.label + ": column 'frame' has no number in any row with a centre");
    }
    std::vector<Eigen::Matrix3Xd> images;
    for (const auto& [frame, list] : centres) {
        images.emplace_back(Eigen::Map<const Eigen::Matrix3Xd>(list.front().data(), 3, static_cast<Index>(list.size())));
    }
    return images;
}

/// Coordinates in another unit are far from what particles of this diameter could be.
void require_plausible(const Eigen::Matrix3Xd& centres, double diameter, const std::string& label) {
    constexpr double least = 1e-3;
    const Eigen::Array3d box = (centres.rowwise().maxCoeff() - centres.rowwise().minCoeff()).array() + diameter;
    const double filled = static_cast<double>(centres.cols()) * std::numbers::pi / 6 * std::pow(diameter, 3) / box.prod();
    if (!(filled >= least && filled <= 1)) {
        throw InputError(label + ": particles of " + to_text(diameter / 2) + " m radius at these coordinates would fill " +
                         (filled > 1 ? "more than all" : "less than a thousandth") +
                         " of the box around them: check the unit of the coordinates and sample.particle_radius");
    }
}

/// Neighbours in shells, mean over the images, with the errors of one, because they are of the same particles; none where no
/// image has enough particles far enough from the faces.
std::vector<Observation> neighbours_in(const std::vector<Eigen::Matrix3Xd>& images, std::size_t number, double diameter) {
    std::vector<NeighbourShells> shells;
    for (const Eigen::Matrix3Xd& image : images) {
        shells.push_back(shells_of_points(image, diameter));
        if (shells.back().centres < fewest_centres) {
            shells.pop_back();
        }
    }
    if (shells.empty()) {
        return {};
    }
    const auto mean = [&](const auto& value) {
        return std::transform_reduce(shells.begin(), shells.end(), 0.0, std::plus(), value) / static_cast<double>(shells.size());
    };
    const double centres = mean([](const NeighbourShells& one) { return static_cast<double>(one.centres); });
    std::vector<double> variances(shell_count);
    for (std::size_t shell = 0; shell < shell_count; ++shell) {
        variances[shell] = mean([&](const NeighbourShells& one) { return one.variances[shell]; });
    }
    std::vector<Observation> all;
    for (const ShellGroup& group : groups_of_shells(variances)) {
        const double value = mean([&](const NeighbourShells& one) {
            const auto first = one.mean.begin() + group.first;
            return std::accumulate(first, first + group.count, 0.0);
        });
        const auto first = static_cast<std::size_t>(group.first);
        const Neighbours seen{.distance = inner_end(first) + 0.5 * shell_width * group.count,
                              .shells = static_cast<std::size_t>(group.count),
                              .centres = centres,
                              .mutual = mean([](const NeighbourShells& one) { return one.mutual; })};
        all.push_back({{}, number, first, seen, value, error_of_count(group.variance) / centres});
    }
    return all;
}

}  // namespace

std::vector<Observation> seen_in_images(const Experiment& experiment, std::size_t number) {
    const Measurement& table = experiment.measurements[number];
    const double diameter = 2 * experiment.sample.particle_radius;
    const std::vector<Eigen::Matrix3Xd> images = images_in(table);
    for (const Eigen::Matrix3Xd& image : images) {
        require_plausible(image, diameter, table.label);
    }
    std::vector<Observation> all = neighbours_in(images, number, diameter);
    if (images.size() >= 2) {
        const RepeatedImages seen = compare_images(images, diameter, table.label);
        if (seen.centres >= fewest_centres) {
            for (Observation& one : planned_images(number, seen.centres)) {
                const ImageQuantity quantity = std::get<ImageDifference>(one.what).quantity;
                one.value = seen.values[static_cast<std::size_t>(quantity)];
                one.standard_error = error_of(quantity, one.value, seen.centres);
                all.push_back(one);
            }
        }
    }
    return all;
}

std::vector<Observation> planned_images(std::size_t measurement, double centres) {
    std::vector<Observation> all;
    for (const ImageQuantity quantity : {ImageQuantity::plane, ImageQuantity::axis, ImageQuantity::unmatched}) {
        all.push_back({{}, measurement, shell_count + all.size(), ImageDifference{quantity, centres}});
    }
    return all;
}

std::vector<Observation> pores_in(const Experiment& experiment, std::size_t number) {
    const Measurement& table = experiment.measurements[number];
    const Column& column = *find_column(table, "exclusion_probability");
    std::vector<Observation> all;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double value = column.values[row];
        const double radius = cell(table, "pore_radius", row);
        const double stated = column.standard_errors.empty() ? unset : column.standard_errors[row];
        if (value > rarest && value < 1 && radius > 0) {
            all.push_back({{}, number, row, Pore{radius}, value, std::isnan(stated) ? unstated_error_of_curve : stated});
        }
    }
    return all;
}

}  // namespace coagula::diagnose
