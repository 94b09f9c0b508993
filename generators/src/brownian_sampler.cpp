#include "brownian_sampler.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace coagula::generators {

BrownianSampler::BrownianSampler(const PairPotential& potential, const ReducedUnits& units, double cutoff, double contact_tolerance)
    : potential_(potential), mean_radius_(units.length), cutoff_(cutoff), tolerance_(contact_tolerance) {}

void BrownianSampler::resume(const BrownianSeries& series, const Pairs& contacts) {
    series_ = series;
    contacts_ = contacts;
}

void BrownianSampler::sample(const Packing& packing, double time) {
    const Eigen::VectorXd& radii = packing.radii;
    const double reach = std::max(2 * radii.maxCoeff() + cutoff_, 2 * (1 + tolerance_) * radii.maxCoeff());
    const ContactNetwork pairs = find_pairs(packing, reach);
    double energy = 0;
    double gaps = 0;
    Pairs now(2, pairs.size());
    Index contacts = 0;
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        const auto ends = pairs.ends.col(pair);
        const double sum = radii[ends[0]] + radii[ends[1]];
        const double gap = pairs.branch.col(pair).norm() - sum;
        if (gap < cutoff_) {
            energy += 2 * radii[ends[0]] * radii[ends[1]] / (sum * mean_radius_) * potential_.energy(gap);
        }
        if (gap < tolerance_ * sum) {
            gaps += gap;
            now.col(contacts++) = ends;
        }
    }
    now.conservativeResize(2, contacts);
    count_changes(now);
    contacts_ = std::move(now);
    count_clusters(packing.size());
    series_.time.push_back(time);
    series_.coordination.push_back(2 * static_cast<double>(contacts) / static_cast<double>(packing.size()));
    series_.energy.push_back(energy);
    series_.mean_gap.push_back(contacts > 0 ? gaps / static_cast<double>(contacts) : 0.0);
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

void BrownianSampler::count_clusters(Index particles) {
    std::vector<std::int32_t> parent(static_cast<std::size_t>(particles));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t particle) {
        while (parent[static_cast<std::size_t>(particle)] != particle) {
            auto& up = parent[static_cast<std::size_t>(particle)];
            up = parent[static_cast<std::size_t>(up)];
            particle = up;
        }
        return particle;
    };
    for (Index pair = 0; pair < contacts_.cols(); ++pair) {
        parent[static_cast<std::size_t>(root(contacts_(0, pair)))] = root(contacts_(1, pair));
    }
    std::vector<std::int64_t> members(parent.size(), 0);
    for (Index particle = 0; particle < particles; ++particle) {
        ++members[static_cast<std::size_t>(root(static_cast<std::int32_t>(particle)))];
    }
    series_.clusters.push_back(std::count_if(members.begin(), members.end(), [](std::int64_t count) { return count > 0; }));
    series_.largest.push_back(*std::max_element(members.begin(), members.end()));
}

}  // namespace coagula::generators
