// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/chord_lengths.hpp>

#include "sample/averaged_particles.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace coagula::characterize {

namespace {

/// Chords of both phases found along one axis, by groups of lines.
struct Chords {
    std::vector<double> voids, solid;  ///< lengths
    std::vector<int> void_group, solid_group;
};

/// The spheres seen along one axis: centres across it in square bins no smaller than the largest radius.
class Shadow {
public:
    Shadow(const Packing& packing, int axis) : packing_(packing), along_(axis), first_((axis + 1) % 3), second_((axis + 2) % 3) {
        const double largest = packing.radii.maxCoeff();
        for (int k = 0; k < 2; ++k) {
            length_[k] = packing.cell.lengths()[across(k)];
            bins_[k] = std::max(1, static_cast<int>(std::min(length_[k] / largest, 1000.0)));
            reach_[k] = static_cast<int>(std::ceil(largest / (length_[k] / bins_[k])));
        }
        spheres_.resize(static_cast<std::size_t>(bins_.prod()));
        for (Index i = 0; i < packing.size(); ++i) {
            const Eigen::Vector3d place = packing.cell.wrap(packing.positions.col(i)) - packing.cell.origin();
            const Eigen::Array2i bin = bin_of({place[first_], place[second_]});
            spheres_[slot(bin)].push_back({place[first_], place[second_], place[along_], packing.radii[i]});
        }
    }

    double length(int k) const { return length_[k]; }
    double along() const { return packing_.cell.lengths()[along_]; }

    /// The intervals (lower, upper) of the line at a place across the axis that lie in spheres; lower in [-r, length).
    std::vector<std::array<double, 2>> intervals(const Eigen::Array2d& line) const {
        std::vector<std::array<double, 2>> found;
        const Eigen::Array2i home = bin_of(line);
        for (int u = -reach_[0]; u <= reach_[0]; ++u) {
            for (int v = -reach_[1]; v <= reach_[1]; ++v) {
                Eigen::Array2i bin = home + Eigen::Array2i(u, v);
                Eigen::Array2d shift;
                for (int k = 0; k < 2; ++k) {
                    const int turns = static_cast<int>(std::floor(static_cast<double>(bin[k]) / bins_[k]));
                    bin[k] -= turns * bins_[k];
                    shift[k] = turns * length_[k];
                }
                for (const Disc& disc : spheres_[slot(bin)]) {
                    const double x = disc.first + shift[0] - line[0], y = disc.second + shift[1] - line[1];
                    const double squared = disc.radius * disc.radius - x * x - y * y;
                    if (squared > 0) {
                        found.push_back({disc.along - std::sqrt(squared), disc.along + std::sqrt(squared)});
                    }
                }
            }
        }
        return found;
    }

private:
    struct Disc {
        double first, second, along, radius;
    };

    int across(int k) const { return k == 0 ? first_ : second_; }
    std::size_t slot(const Eigen::Array2i& bin) const {
        const int number = bin[1] * bins_[0] + bin[0];
        return static_cast<std::size_t>(number);
    }
    Eigen::Array2i bin_of(const Eigen::Array2d& place) const {
        return (place / length_ * bins_.cast<double>()).cast<int>().max(0).min(bins_ - 1);
    }

    const Packing& packing_;
    int along_, first_, second_;
    Eigen::Array2d length_;
    Eigen::Array2i bins_;
    Eigen::Array2i reach_;
    std::vector<std::vector<Disc>> spheres_;
};

/// Unites the intervals of a closed line of the given length and adds what lies in them and between them.
void add_line(std::vector<std::array<double, 2>> intervals, double length, int group, Chords& chords) {
    std::sort(intervals.begin(), intervals.end());
    std::vector<std::array<double, 2>> united;
    for (const auto& interval : intervals) {
        if (united.empty() || interval[0] > united.back()[1]) {
            united.push_back(interval);
        } else {
            united.back()[1] = std::max(united.back()[1], interval[1]);
        }
    }
    while (united.size() > 1 && united.back()[1] >= united.front()[0] + length) {  // the last reaches the first, one turn on
        united.back()[1] = std::max(united.back()[1], united.front()[1] + length);
        united.erase(united.begin());
    }
    if (united.empty() || united.back()[1] - united.front()[0] >= length) {
        return;  // all void or all solid: no chord ends
    }
    for (std::size_t k = 0; k < united.size(); ++k) {
        const double next = k + 1 < united.size() ? united[k + 1][0] : united.front()[0] + length;
        chords.solid.push_back(united[k][1] - united[k][0]);
        chords.voids.push_back(next - united[k][1]);
        chords.solid_group.push_back(group);
        chords.void_group.push_back(group);
    }
}

constexpr int groups_per_side = 5;
constexpr Index groups = Index{groups_per_side} * groups_per_side;

/// Lines on the points of a Kronecker sequence with the plastic number, which fill the square evenly for any number of lines.
Chords chords_along(const Packing& packing, int axis, Index lines, BlockSums& void_length, const Progress& progress) {
    constexpr double plastic = 1.3247179572447460;
    constexpr Index looks = 1000;  // lines between two looks at the progress callback
    const Shadow shadow(packing, axis);
    Chords chords;
    for (Index line = 0; line < lines; ++line) {
        if (line % looks == 0) {
            progress.update("chord lengths", (axis + static_cast<double>(line) / static_cast<double>(lines)) / 3);
        }
        const Eigen::Array2d turns = (static_cast<double>(line) + 0.5) * Eigen::Array2d(1 / plastic, 1 / (plastic * plastic));
        const Eigen::Array2d fraction = turns - turns.floor();
        const Eigen::Array2i block = (groups_per_side * fraction).cast<int>().min(groups_per_side - 1);
        const int group = groups_per_side * block[1] + block[0];
        const std::size_t before = chords.voids.size();
        const auto intervals = shadow.intervals({fraction[0] * shadow.length(0), fraction[1] * shadow.length(1)});
        add_line(intervals, shadow.along(), group, chords);
        const auto added = chords.voids.begin() + static_cast<std::ptrdiff_t>(before);
        const double empty = intervals.empty() ? shadow.along() : std::accumulate(added, chords.voids.end(), 0.0);
        void_length.add(group, empty / shadow.along());
    }
    return chords;
}

ChordDistribution distribution_of(const std::array<const std::vector<double>*, 3>& lengths,
                                  const std::array<const std::vector<int>*, 3>& groups_of, Index bins) {
    ChordDistribution result;
    double longest = 0;
    BlockSums all(groups);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        BlockSums own(groups);
        for (std::size_t k = 0; k < lengths[axis]->size(); ++k) {
            const double length = (*lengths[axis])[k];
            own.add((*groups_of[axis])[k], length);
            all.add((*groups_of[axis])[k], length);
            longest = std::max(longest, length);
        }
        result.mean_by_axis[static_cast<Index>(axis)] = own.weight() > 0 ? own.mean() : unset;
    }
    result.chords = static_cast<Index>(all.weight());
    require(result.chords > 0, "no line through the packing meets both spheres and voids: there are no chords to measure");
    result.mean = all.mean();
    result.second_moment = 0;
    const double width = longest / static_cast<double>(bins);
    result.length = Eigen::VectorXd::LinSpaced(bins, width / 2, longest - width / 2);
    result.density = Eigen::VectorXd::Zero(bins);
    for (const auto* const of_axis : lengths) {
        for (const double length : *of_axis) {
            result.second_moment += length * length / all.weight();
            result.density[std::min(bins - 1, static_cast<Index>(length / width))] += 1 / (width * all.weight());
        }
    }
    return result;
}

/// Standard errors of the means and mean squares of the chords in the void and in the solid along one axis. Structures of the same
/// kind have the same void fraction, with which the chords of a group of lines vary most.
Eigen::Vector4d chord_errors(const Chords& chords) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(5, groups);
    for (std::size_t k = 0; k < chords.voids.size(); ++k) {
        sums.col(chords.void_group[k]).head<3>() += Eigen::Vector3d(1, chords.voids[k], chords.voids[k] * chords.voids[k]);
        sums.col(chords.solid_group[k]).tail<2>() += Eigen::Vector2d(chords.solid[k], chords.solid[k] * chords.solid[k]);
    }
    return block_errors(
        sums, [](const Eigen::VectorXd& sum) -> Eigen::VectorXd { return sum.tail<4>() / sum[0]; },
        [](const Eigen::VectorXd& sum) { return sum[1] / (sum[1] + sum[3]); });
}

/// The axes see the same structure: their errors are not independent.
void add_errors(const std::array<Chords, 3>& chords, ChordLengths& result) {
    Eigen::Matrix<double, 4, 3> errors;
    for (int axis = 0; axis < 3; ++axis) {
        errors.col(axis) = chord_errors(chords[static_cast<std::size_t>(axis)]);
    }
    const Eigen::Vector4d mean = errors.rowwise().mean();
    result.voids.mean_stderr = mean[0];
    result.voids.second_moment_stderr = mean[1];
    result.voids.stderr_by_axis = errors.row(0);
    result.solid.mean_stderr = mean[2];
    result.solid.second_moment_stderr = mean[3];
    result.solid.stderr_by_axis = errors.row(2);
}

}  // namespace

ChordLengths measure_chord_lengths(const Packing& packing, const ChordOptions& options, const Progress& progress) {
    check(packing);
    require(packing.cell.is_periodic(), "chords are measured in periodic packings only, and this one has a free surface");
    require(options.lines >= 1 && options.bins >= 1, "the chord lengths need at least one line along each axis and one bin");
    ChordLengths result;
    result.void_fraction = result.void_fraction_stderr = 0;
    std::array<Chords, 3> chords;
    for (int axis = 0; axis < 3; ++axis) {
        BlockSums void_length(groups);
        chords[static_cast<std::size_t>(axis)] = chords_along(packing, axis, options.lines, void_length, progress);
        result.void_fraction += void_length.mean() / 3;
        result.void_fraction_stderr += void_length.mean_stderr() / 3;
    }
    result.voids = distribution_of({&chords[0].voids, &chords[1].voids, &chords[2].voids},
                                   {&chords[0].void_group, &chords[1].void_group, &chords[2].void_group}, options.bins);
    result.solid = distribution_of({&chords[0].solid, &chords[1].solid, &chords[2].solid},
                                   {&chords[0].solid_group, &chords[1].solid_group, &chords[2].solid_group}, options.bins);
    add_errors(chords, result);
    return result;
}

}  // namespace coagula::characterize
