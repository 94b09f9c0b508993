// SPDX-License-Identifier: GPL-3.0-or-later
#include "brownian_sampler.hpp"

#include <coagula/common/percolation.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace coagula::generators {

BrownianSampler::BrownianSampler(const PairPotential& potential, const ReducedUnits& units, double cutoff, double contact_tolerance)
    : potential_(potential), units_(units), cutoff_(cutoff), tolerance_(contact_tolerance) {}

void BrownianSampler::resume(const BrownianSeries& series, const Pairs& contacts) {
    series_ = series;
    contacts_ = contacts;
}

void BrownianSampler::sample(const Packing& packing, double time, const SpringEnergy& resistance) {
    const Eigen::VectorXd& radii = packing.radii;
    const double reach = std::max(2 * radii.maxCoeff() + cutoff_, 2 * (1 + tolerance_) * radii.maxCoeff());
    const ContactNetwork pairs = find_pairs(packing, reach);
    double energy = 0;
    double gaps = 0;
    ContactNetwork now{pairs.particles, Pairs(2, pairs.size()), Eigen::Matrix3Xd(3, pairs.size())};
    Index contacts = 0;
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto ends = pairs.ends.col(pair);
        const double sum = radii[ends[0]] + radii[ends[1]];
        const double gap = pairs.branch.col(pair).norm() - sum;
        if (gap < cutoff_) {
            energy += 2 * radii[ends[0]] * radii[ends[1]] / (sum * units_.length) * potential_.energy(gap);
        }
        if (gap < tolerance_ * sum) {
            gaps += gap;
            now.ends.col(contacts) = ends;
            now.branch.col(contacts++) = pairs.branch.col(pair);
        }
    }
    now.ends.conservativeResize(2, contacts);
    now.branch.conservativeResize(3, contacts);
    count_changes(now.ends);
    count_clusters(packing, now);
    contacts_ = std::move(now.ends);
    series_.time.push_back(time);
    series_.coordination.push_back(2 * static_cast<double>(contacts) / static_cast<double>(packing.size()));
    series_.energy.push_back(energy);
    series_.sliding_energy.push_back(resistance.sliding * units_.energy);
    series_.rolling_energy.push_back(resistance.rolling * units_.energy);
    series_.mean_gap.push_back(contacts > 0 ? gaps / static_cast<double>(contacts) : 0.0);
}

void BrownianSampler::add_stress(const Packing& packing, double strain, const StressSum& sum) {
    const double scale = units_.energy / packing.cell.volume();
    const auto times = static_cast<double>(sum.times);
    const double brownian = -scale * static_cast<double>(packing.size());  // the pressure of an ideal gas
    const Eigen::Matrix3d sliding = scale / times * sum.sliding;
    const Eigen::Matrix3d all = scale / times * sum.pairs + sliding;
    StressSeries& series = series_.stress;
    series.strain.push_back(strain);
    series.shear_stress.push_back(all(2, 0));
    series.contact_shear_stress.push_back(sliding(2, 0));
    series.normal_stress_x.push_back(all(0, 0) + brownian);
    series.normal_stress_y.push_back(all(1, 1) + brownian);
    series.normal_stress_z.push_back(all(2, 2) + brownian);
}

/// Both lists are sorted.
void BrownianSampler::count_changes(const Pairs& now) {
    const auto key = [](const Pairs& pairs, Index pair) { return std::array{pairs(0, pair), pairs(1, pair)}; };
    Index old_one = 0;
    Index new_one = 0;
    std::int64_t kept = 0;
    while (old_one < contacts_.cols() && new_one < now.cols()) {
        const auto before = key(contacts_, old_one);
        const auto after = key(now, new_one);
        kept += before == after ? 1 : 0;
        old_one += before <= after ? 1 : 0;
        new_one += after <= before ? 1 : 0;
    }
    series_.formed.push_back(series_.time.empty() ? 0 : now.cols() - kept);
    series_.broken.push_back(contacts_.cols() - kept);
}

void BrownianSampler::count_clusters(const Packing& packing, const ContactNetwork& contacts) {
    const std::vector<Cluster> clusters = find_clusters(packing, contacts);
    Index joined = 0;
    for (const Cluster& cluster : clusters) {
        joined += cluster.particles;
    }
    std::int64_t axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        axes += std::any_of(clusters.begin(), clusters.end(), [axis](const Cluster& one) { return one.percolates(axis); }) ? 1 : 0;
    }
    series_.clusters.push_back(static_cast<std::int64_t>(clusters.size()) + packing.size() - joined);
    series_.largest.push_back(clusters.empty() ? 1 : clusters.front().particles);
    series_.percolating.push_back(axes);
}

}  // namespace coagula::generators
