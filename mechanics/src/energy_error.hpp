// SPDX-License-Identifier: GPL-3.0-or-later
// How far conjugate gradients are from the least energy.
#pragma once

#include "column_sums.hpp"
#include "resisted_strains.hpp"

#include <Eigen/Core>

#include <deque>
#include <limits>

namespace coagula::mechanics {

/// Estimates the error of the energy, per column and relative to the energy that is left, from what the last iterations gained.
class EnergyError {
public:
    using Row = SixValues<double>;
    using Columns = Eigen::Array<bool, 1, 6>;

    static constexpr double rounding = 1e-13;

    explicit EnergyError(const Row& affine_energy) : affine_energy_(affine_energy) {}

    /// @param open the columns that are being solved: the others keep their estimate.
    void add(const Row& gain, const Columns& open) {
        recent_.push_back(gain);
        sum_ += gain;
        total_ += gain;
        if (recent_.size() > delay) {
            sum_ -= recent_.front();
            recent_.pop_front();
        }
        const Row left = (affine_energy_ - total_).max(rounding_modulus * affine_energy_).max(1e-300);
        const Columns settled = gain > 0 && gain <= rounding * left;
        const Row before_delay = settled.select(gain / left, std::numeric_limits<double>::infinity());
        estimate_ = (open && gain > 0).select(recent_.size() < delay ? before_delay : sum_.max(0.0) / left, estimate_);
    }
    /// Infinite until enough iterations have passed, or one has gained no more than rounding errors.
    const Row& estimate() const { return estimate_; }

private:
    static constexpr std::size_t delay = 10;  ///< iterations whose gain estimates the error before them

    Row affine_energy_;
    std::deque<Row> recent_;
    Row sum_ = Row::Zero();
    Row total_ = Row::Zero();
    Row estimate_ = Row::Constant(std::numeric_limits<double>::infinity());
};

}  // namespace coagula::mechanics
