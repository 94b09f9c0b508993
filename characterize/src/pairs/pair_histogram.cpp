// SPDX-License-Identifier: GPL-3.0-or-later
#include "pair_histogram.hpp"

#include "pair_runs.hpp"
#include "sample/averaged_particles.hpp"

#include <array>
#include <numbers>

namespace coagula::characterize {

namespace {

constexpr double sphere = 4 * std::numbers::pi / 3;

/// The block of each particle, and the first bin that reaches out of the window from it.
struct Centres {
    SpaceBlocks blocks;
    std::vector<std::int32_t> bins;
};

Centres find_centres(const Packing& packing, const SampleWindow& window, double width, Index bins, PairDistance distance) {
    const double largest = packing.radii.maxCoeff();
    Centres centres{space_blocks(packing), {}};
    for (Index i = 0; i < packing.size(); ++i) {
        const double unit = distance == PairDistance::by_contact ? packing.radii[i] + largest : 1.0;
        centres.bins.push_back(static_cast<std::int32_t>(std::min(window.depth[i] / (unit * width), static_cast<double>(bins))));
    }
    return centres;
}

/// Mean over the other particles of the volume of a shell 4 pi / 3 (upper^3 - lower^3) = 1, in the unit of the distance.
Eigen::VectorXd unit_volumes(const Packing& packing, PairDistance distance) {
    const auto particles = static_cast<double>(packing.size());
    if (distance == PairDistance::by_mean_diameter || packing.size() < 2) {
        return Eigen::VectorXd::Ones(packing.size());
    }
    const Eigen::ArrayXd r = packing.radii.array();
    const double sum = r.sum(), squares = r.square().sum(), cubes = r.cube().sum();
    const Eigen::ArrayXd all = particles * r.cube() + 3 * r.square() * sum + 3 * r * squares + cubes;
    return (all - 8 * r.cube()) / (particles - 1);
}

void add_expected(const Packing& packing, const SampleWindow& window, const Centres& centres, PairDistance distance,
                  PairHistogram& histogram) {
    const Index bins = histogram.pairs.rows();
    const Eigen::VectorXd volume = unit_volumes(packing, distance);
    // Changes with the bin at which a centre ceases to count; summed up below.
    Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(bins + 1, centres.blocks.count);
    Eigen::VectorXd centre_changes = Eigen::VectorXd::Zero(bins + 1);
    for (Index i = 0; i < packing.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        changes(centres.bins[k], centres.blocks.of_particle[k]) += volume[i];
        centre_changes[centres.bins[k]] += 1;
    }
    histogram.expected = Eigen::MatrixXd::Zero(bins, centres.blocks.count);
    histogram.centres.resize(bins);
    Eigen::RowVectorXd weight = Eigen::RowVectorXd::Zero(centres.blocks.count);
    double count = 0;
    for (Index bin = bins; bin-- > 0;) {
        weight += changes.row(bin + 1);
        count += centre_changes[bin + 1];
        const auto k = static_cast<double>(bin);
        const double shell = sphere * histogram.width * histogram.width * histogram.width * (3 * k * (k + 1) + 1);
        histogram.expected.row(bin) = window.pair_density * shell * weight;
        histogram.centres[bin] = count;
    }
}

/// Squared distances of one entry to a run of others, a chunk at a time.
constexpr Index chunk = 256;
void squared_distances(const PairRuns& runs, Index entry, Index begin, Index end, const Eigen::Vector3d& shift, double* squares) {
    const auto e = static_cast<std::size_t>(entry);
    const double x = runs.x[e] - shift[0], y = runs.y[e] - shift[1], z = runs.z[e] - shift[2];
    const double* const px = runs.x.data() + begin;
    const double* const py = runs.y.data() + begin;
    const double* const pz = runs.z.data() + begin;
#pragma omp simd
    for (Index k = 0; k < end - begin; ++k) {
        const double dx = px[k] - x, dy = py[k] - y, dz = pz[k] - z;
        squares[k] = dx * dx + dy * dy + dz * dz;
    }
}

/// Counts pairs by block and bin.
class PairCounter {
public:
    /// @param width of a bin.
    PairCounter(const Packing& packing, const PairRuns& runs, const Centres& centres, double width, Index bins, bool scaled)
        : packing_(packing),
          runs_(runs),
          centres_(centres),
          inverse_width_(1 / width),
          bins_(bins),
          scaled_(scaled),
          counts_(Eigen::MatrixXi::Zero(centres.blocks.count, bins)) {}

    /// Counts the pairs that one entry of the runs makes with a run of others.
    void operator()(Index entry, Index first, Index last, const Eigen::Vector3d& shift) {
        const auto i = static_cast<std::size_t>(runs_.particle[static_cast<std::size_t>(entry)]);
        for (Index begin = first; begin < last; begin += chunk) {
            const Index end = std::min(begin + chunk, last);
            squared_distances(runs_, entry, begin, end, shift, squares_.data());
            for (Index e = begin; e < end; ++e) {
                const auto j = static_cast<std::size_t>(runs_.particle[static_cast<std::size_t>(e)]);
                add(i, j, squares_[static_cast<std::size_t>(e - begin)]);
            }
        }
    }

    const Eigen::MatrixXi& counts() const { return counts_; }

private:
    void add(std::size_t i, std::size_t j, double square) {
        const double unit = scaled_ ? packing_.radii[static_cast<Index>(i)] + packing_.radii[static_cast<Index>(j)] : 1.0;
        const double place = std::sqrt(square) / unit * inverse_width_;
        if (place < static_cast<double>(bins_)) {
            const auto bin = static_cast<std::int32_t>(place);
            // Both ends count in the block of one of them, so that blocks are independent.
            const std::size_t owner = ((i + j) & 1U) != 0 ? std::min(i, j) : std::max(i, j);
            counts_(centres_.blocks.of_particle[owner], bin) += (bin < centres_.bins[i] ? 1 : 0) + (bin < centres_.bins[j] ? 1 : 0);
        }
    }

    const Packing& packing_;
    const PairRuns& runs_;
    const Centres& centres_;
    double inverse_width_;
    Index bins_;
    bool scaled_;
    Eigen::MatrixXi counts_;
    std::array<double, chunk> squares_{};
};

}  // namespace

PairHistogram count_pairs(const Packing& packing, const SampleWindow& window, double range, Index bins, PairDistance distance) {
    PairHistogram histogram;
    const bool scaled = distance == PairDistance::by_contact;
    histogram.width = range / static_cast<double>(bins);
    const Centres centres = find_centres(packing, window, histogram.width, bins, distance);
    histogram.pairs = Eigen::MatrixXd::Zero(bins, centres.blocks.count);
    const double reach = scaled ? 2 * packing.radii.maxCoeff() * range : range;
    const PairRuns runs(packing, reach);
#pragma omp parallel
    {
        PairCounter count(packing, runs, centres, histogram.width, bins, scaled);
#pragma omp for schedule(dynamic)
        for (Index row = 0; row < runs.rows(); ++row) {
            runs.for_each_run(row, count);
        }
#pragma omp critical
        histogram.pairs += count.counts().transpose().cast<double>();
    }
    add_expected(packing, window, centres, distance, histogram);
    return histogram;
}

double largest_pair_distance(const Packing& packing, const SampleWindow& window) {
    const double half_period = packing.cell.half_period();
    if (packing.cell.is_periodic()) {
        return half_period;
    }
    std::vector<double> depth(window.depth.begin(), window.depth.end());
    const auto tenth = depth.begin() + static_cast<std::ptrdiff_t>(depth.size() * 9 / 10);
    std::nth_element(depth.begin(), tenth, depth.end());
    return std::min(*tenth, half_period);
}

}  // namespace coagula::characterize
