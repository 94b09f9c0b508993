// SPDX-License-Identifier: GPL-3.0-or-later
// The time series of a Brownian run.
#pragma once

#include <coagula/generators/brownian_dynamics.hpp>

#include "contact_springs.hpp"
#include "reduced_units.hpp"

namespace coagula::generators {

class BrownianSampler {
public:
    /// @param cutoff gap beyond which pairs have no energy [m].
    BrownianSampler(const PairPotential& potential, const ReducedUnits& units, double cutoff, double contact_tolerance);

    /// Appends the values of this packing to the series. @param resistance energy of sliding and rolling, over kB T.
    void sample(const Packing& packing, double time, const SpringEnergy& resistance);

    /// Appends the mean stress since the sample before. @param packing that of the sample.
    void add_stress(const Packing& packing, double strain, const StressSum& sum);

    using Pairs = Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic>;
    void resume(const BrownianSeries& series, const Pairs& contacts);
    const BrownianSeries& series() const { return series_; }
    /// Of the last sample.
    const Pairs& contacts() const { return contacts_; }

private:
    void count_clusters(const Packing& packing, const ContactNetwork& contacts);
    void count_changes(const Pairs& now);

    const PairPotential& potential_;
    ReducedUnits units_;
    double cutoff_;
    double tolerance_;
    BrownianSeries series_;
    Pairs contacts_;
};

}  // namespace coagula::generators
