// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/density_fluctuations.hpp>

#include <coagula/common/cell_list.hpp>

#include "geometry/reduced_diagram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace coagula::characterize {

namespace {

/// Values on a grid along x, y and z, x fastest: over the box, or over the space around a tilted one and the widest window.
struct Grid {
    Eigen::Array3i count;
    Eigen::Array3d spacing;  ///< [m]
    Eigen::Vector3d origin;  ///< [m]
    std::vector<double> values;

    std::size_t at(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count[1]) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count[0]) +
               static_cast<std::size_t>(x);
    }
    Index size() const { return static_cast<Index>(count[0]) * count[1] * count[2]; }
};

/// The widest windows: half of a periodic box, all of an open one.
double longest_window(const Cell& cell, double r0) {
    double longest = (largest_window + 1) * r0;
    for (int axis = 0; axis < 3; ++axis) {
        longest = std::min(longest, cell.widths()[axis] * (cell.is_periodic(axis) ? 0.5 : 1.0));
    }
    return longest;
}

Grid make_grid(const Cell& cell, double r0) {
    constexpr double most_points = 1.6e7;
    Eigen::Array3d lengths = cell.bounds().lengths();
    lengths += cell.is_rectangular() ? 0.0 : longest_window(cell, r0);
    const double spacing = std::max(0.5 * r0, std::cbrt(lengths.prod() / most_points));
    Grid grid;
    grid.origin = cell.bounds().origin();
    grid.count = (lengths / spacing).round().max(1.0).cast<int>();
    grid.spacing = lengths / grid.count.cast<double>();
    grid.values.assign(static_cast<std::size_t>(grid.size()), 0.0);
    return grid;
}

/// Calls visit(position) for the images of a particle that may lie on the grid.
template <class Visit>
void for_each_image(const Cell& cell, const Grid& grid, const Eigen::Vector3d& position, const Visit& visit) {
    if (cell.is_rectangular()) {
        visit(cell.wrap(position));
        return;
    }
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d high = -low;
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Array3d side(corner & 1, corner >> 1 & 1, corner >> 2);
        const Eigen::Vector3d end = grid.origin + (side * grid.count.cast<double>() * grid.spacing).matrix();
        low = low.min(cell.in_edges(end - position).array());
        high = high.max(cell.in_edges(end - position).array());
    }
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = cell.is_periodic(axis) ? std::ceil(low[axis]) : 0.0;
        high[axis] = cell.is_periodic(axis) ? std::floor(high[axis]) : 0.0;
    }
    for (double x = low[0]; x <= high[0]; ++x) {
        for (double y = low[1]; y <= high[1]; ++y) {
            for (double z = low[2]; z <= high[2]; ++z) {
                visit(Eigen::Vector3d(position + cell.edges() * Eigen::Vector3d(x, y, z)));
            }
        }
    }
}

/// Solid volume over the mean of a particle, at the grid cells of the centres.
Grid solid_grid(const Packing& packing, double r0) {
    Grid grid = make_grid(packing.cell, r0);
    const double mean = solid_volume(packing) / static_cast<double>(packing.size());
    for (Index i = 0; i < packing.size(); ++i) {
        const double radius = packing.radii[i];
        for_each_image(packing.cell, grid, packing.positions.col(i), [&](const Eigen::Vector3d& image) {
            Eigen::Array3i box = ((image - grid.origin).array() / grid.spacing).floor().cast<int>();
            if (packing.cell.is_rectangular()) {
                box = box.max(0).min(grid.count - 1);
            }
            if ((box >= 0).all() && (box < grid.count).all()) {
                grid.values[grid.at(box[0], box[1], box[2])] += 4 * std::numbers::pi / 3 * radius * radius * radius / mean;
            }
        });
    }
    return grid;
}

/// 1 at the grid cells whose middle has an inner particle for the nearest.
Grid certain_grid(const Packing& packing, const std::vector<bool>& inner, double r0) {
    Grid grid = make_grid(packing.cell, r0);
    const double reach = 2 * std::cbrt(packing.cell.volume() / static_cast<double>(packing.size()));
    const CellList cells(packing.cell, packing.positions, reach);
#pragma omp parallel for schedule(dynamic)
    for (int z = 0; z < grid.count[2]; ++z) {
        for (int y = 0; y < grid.count[1]; ++y) {
            for (int x = 0; x < grid.count[0]; ++x) {
                const Eigen::Array3d place = (Eigen::Array3d(x, y, z) + 0.5) * grid.spacing;
                double nearest = std::numeric_limits<double>::infinity();
                bool certain = false;
                cells.for_each_near(grid.origin + place.matrix(), [&](int particle, const Eigen::Vector3d& separation) {
                    const double power = separation.squaredNorm() - packing.radii[particle] * packing.radii[particle];
                    if (power < nearest) {
                        nearest = power;
                        certain = inner[static_cast<std::size_t>(particle)];
                    }
                });
                grid.values[grid.at(x, y, z)] = certain ? 1.0 : 0.0;
            }
        }
    }
    return grid;
}

/// Sums over `width` successive values of a ring.
void sum_ring(std::vector<double>& line, int width) {
    const std::vector<double> values = line;
    const auto count = static_cast<int>(values.size());
    double sum = 0;
    for (int k = 0; k < width; ++k) {
        sum += values[static_cast<std::size_t>(k % count)];
    }
    for (int k = 0; k < count; ++k) {
        line[static_cast<std::size_t>(k)] = sum;
        sum += values[static_cast<std::size_t>((k + width) % count)] - values[static_cast<std::size_t>(k)];
    }
}

/// The sums over windows of width^3 grid cells from each grid cell on, through the periodic boundary.
Grid window_sums(Grid grid, int width) {
    for (int axis = 0; axis < 3; ++axis) {
        const int second = (axis + 1) % 3;
        const int third = (axis + 2) % 3;
#pragma omp parallel for schedule(static)
        for (int j = 0; j < grid.count[third]; ++j) {
            std::vector<double> line(static_cast<std::size_t>(grid.count[axis]));
            Eigen::Array3i place;
            for (int i = 0; i < grid.count[second]; ++i) {
                place[second] = i;
                place[third] = j;
                const auto value = [&](int k) -> double& {
                    place[axis] = k;
                    return grid.values[grid.at(place[0], place[1], place[2])];
                };
                for (int k = 0; k < grid.count[axis]; ++k) {
                    line[static_cast<std::size_t>(k)] = value(k);
                }
                sum_ring(line, width);
                for (int k = 0; k < grid.count[axis]; ++k) {
                    value(k) = line[static_cast<std::size_t>(k)];
                }
            }
        }
    }
    return grid;
}

/// Number of the sub-volume (0 to 7) that a window belongs to; -1 if it is not in the box. @param place its lowest grid cell.
int sub_volume(const Cell& cell, const Grid& grid, const Eigen::Array3i& place, int width) {
    const auto number = [](const Eigen::Array3i& half) { return (half[2] * 2 + half[1]) * 2 + half[0]; };
    for (int axis = 0; axis < 3; ++axis) {
        if (!cell.is_periodic(axis) && place[axis] + width > grid.count[axis]) {
            return -1;
        }
    }
    if (cell.is_rectangular()) {
        return number(place * 2 / grid.count);
    }
    const Eigen::Vector3d middle = grid.origin + ((place.cast<double>() + 0.5) * grid.spacing).matrix();
    const Eigen::Array3d fraction = cell.fraction(middle);
    const bool is_inside = (fraction >= 0).all() && (fraction < 1).all() && (place + width <= grid.count).all();
    return is_inside ? number((2 * fraction).cast<int>()) : -1;
}

/// Number of windows, sum and sum of squares of their contents, by sub-volume (8 columns).
/// @param certain where there is a free surface: windows lie in the part of space that is known.
Eigen::Matrix3Xd sum_windows(const Cell& cell, const Grid& contents, const Grid* certain, int width) {
    constexpr Index sub_volumes = 8;
    const double full = width * width * width - 0.5;
    Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, sub_volumes);
    for (int z = 0; z < contents.count[2]; ++z) {
        for (int y = 0; y < contents.count[1]; ++y) {
            for (int x = 0; x < contents.count[0]; ++x) {
                const std::size_t place = contents.at(x, y, z);
                const int part = sub_volume(cell, contents, {x, y, z}, width);
                if (part >= 0 && (certain == nullptr || certain->values[place] > full)) {
                    const double value = contents.values[place];
                    sums.col(part) += Eigen::Vector3d(1, value, value * value);
                }
            }
        }
    }
    return sums;
}

/// Integral of a power law between successive points, over [low, high]; the curve covers the range.
double integrate_powers(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, double low, double high) {
    double sum = 0;
    for (Index k = 0; k + 1 < x.size(); ++k) {
        const double from = std::max(low, x[k]);
        const double to = std::min(high, x[k + 1]);
        if (from < to && y[k] > 0 && y[k + 1] > 0) {
            const double power = std::log(y[k + 1] / y[k]) / std::log(x[k + 1] / x[k]);
            const auto value = [&](double at) { return y[k] * std::pow(at / x[k], power); };
            sum += std::abs(power + 1) > 1e-9 ? (to * value(to) - from * value(from)) / (power + 1)
                                              : y[k] * x[k] * std::log(to / from);
        }
    }
    return sum;
}

/// Relative standard deviation from number, sum and sum of squares. @param share of the box that a window takes; 0 if open.
double relative_deviation(const Eigen::Vector3d& sum, double share) {
    const double mean = sum[1] / sum[0];
    const double variance = std::max(0.0, sum[2] / sum[0] - mean * mean) / (1 - share);
    return std::sqrt(variance) / mean;
}

/// The windows of a packing: their widths in grid cells and sums over their contents.
struct Windows {
    std::vector<int> width;
    Eigen::MatrixXd sums;  ///< 3 rows per width: number, sum, sum of squares; by sub-volume
};

Windows sum_all_windows(const Packing& packing, const std::vector<bool>& inner, double r0, double spacing) {
    constexpr double fewest_windows = 100;
    const bool periodic = packing.cell.is_periodic();
    const Grid solid = solid_grid(packing, r0);
    const Grid certain = periodic ? Grid{} : certain_grid(packing, inner, r0);
    const double longest = longest_window(packing.cell, r0);
    Windows windows;
    for (int width = std::max(1, static_cast<int>(smallest_window * r0 / spacing)); width * spacing <= longest; ++width) {
        const Grid inside = periodic ? Grid{} : window_sums(certain, width);
        const Eigen::Matrix3Xd sums = sum_windows(packing.cell, window_sums(solid, width), periodic ? nullptr : &inside, width);
        if (sums.row(0).sum() < fewest_windows || sums.row(1).sum() <= 0) {
            break;
        }
        windows.width.push_back(width);
        windows.sums.conservativeResize(3 * std::ssize(windows.width), sums.cols());
        windows.sums.bottomRows(3) = sums;
    }
    return windows;
}

}  // namespace

DensityFluctuations measure_density_fluctuations(const Packing& given, const std::vector<bool>& inner, double largest) {
    check(given);
    const Packing packing = in_units_of(1.0, given);
    const double r0 = mean_radius(packing);
    const double spacing = std::cbrt(make_grid(packing.cell, r0).spacing.prod());
    const Windows windows = sum_all_windows(packing, inner, r0, spacing);
    const Index count = std::ssize(windows.width);
    require(count >= 3, "the box is too small for density fluctuations: cubic windows of four mean radii must fit into it twice");
    DensityFluctuations found;
    found.edge.resize(count);
    for (Index k = 0; k < count; ++k) {
        found.edge[k] = spacing * windows.width[static_cast<std::size_t>(k)];
    }
    const double box = packing.cell.is_periodic() ? packing.cell.volume() : std::numeric_limits<double>::infinity();
    const Eigen::ArrayXd share = found.edge.array().cube() / box;
    const bool covers = found.edge[0] <= smallest_window * r0 * (1 + 1e-9) && found.edge[count - 1] >= largest * r0 * (1 - 1e-9);
    const auto estimate = [&](const Eigen::VectorXd& sum) {
        Eigen::VectorXd values(count + 1);
        for (Index k = 0; k < count; ++k) {
            values[k] = relative_deviation(sum.segment<3>(3 * k), share[k]);
        }
        values[count] = integrate_powers(found.edge.array() / r0, values.head(count).array(), smallest_window, largest);
        return values;
    };
    const Eigen::VectorXd values = estimate(windows.sums.rowwise().sum());
    const Eigen::VectorXd errors = block_errors(windows.sums, estimate, [](const Eigen::VectorXd& sum) { return sum[1] / sum[0]; });
    found.deviation = values.head(count);
    found.deviation_error = errors.head(count);
    found.integral = covers ? values[count] : unset;
    found.integral_error = covers ? errors[count] : unset;
    return found;
}

LargestDifference compare_density_fluctuations(const DensityFluctuations& first, const DensityFluctuations& second) {
    LargestDifference largest;
    const auto interpolate = [](const Eigen::VectorXd& x, const Eigen::VectorXd& y, double at) {
        const Index k = std::clamp<Index>(std::upper_bound(x.begin(), x.end(), at) - x.begin() - 1, 0, x.size() - 2);
        const double part = (at - x[k]) / (x[k + 1] - x[k]);
        return (1 - part) * y[k] + part * y[k + 1];
    };
    const double end = second.edge[second.edge.size() - 1];
    for (Index k = 0; k < first.edge.size(); ++k) {
        const double edge = first.edge[k];
        if (edge < second.edge[0] || edge > end) {
            continue;
        }
        const double difference = interpolate(second.edge, second.deviation, edge) - first.deviation[k];
        if (!(std::abs(difference) <= std::abs(largest.difference))) {
            largest = {edge, difference,
                       std::hypot(first.deviation_error[k], interpolate(second.edge, second.deviation_error, edge))};
        }
    }
    return largest;
}

}  // namespace coagula::characterize
