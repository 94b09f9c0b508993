// SPDX-License-Identifier: GPL-3.0-or-later
// How far conjugate gradients are from the least energy.
#pragma once

#include "column_sums.hpp"
#include "resisted_strains.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <deque>
#include <limits>
#include <numeric>
#include <utility>

namespace coagula::mechanics {

/// Estimates the error of the energy, per column and relative to the energy that is left, from what the last iterations gained.
class EnergyError {
public:
    using Row = SixValues<double>;
    using Columns = Eigen::Array<bool, 1, 6>;

    static constexpr double rounding = 1e-13;

    explicit EnergyError(Row affine_energy) : affine_energy_(std::move(affine_energy)) {}

    /// @param open the columns that are being solved: the others keep their estimate.
    void add(const Row& gain, const Columns& open) {
        gains_.push_back(gain);
        total_ += gain;
        if (gains_.size() > 2 * delay) {
            gains_.pop_front();
        }
        const Row left = (affine_energy_ - total_).max(rounding_modulus * affine_energy_).max(1e-300);
        const Columns settled = gain > 0 && gain <= rounding * left;
        const Row before_delay = settled.select(gain / left, std::numeric_limits<double>::infinity());
        estimate_ = (open && gain > 0).select(gains_.size() < delay ? before_delay : to_come() / left, estimate_);
    }
    /// Infinite until enough iterations have passed, or one has gained no more than rounding errors.
    const Row& estimate() const { return estimate_; }

private:
    static constexpr std::size_t delay = 10;  ///< iterations whose gain estimates the error before them

    /// Returns what the last iterations gained. Where they gained nearly as much as the same number before them, it returns what a
    /// geometric series has still to gain, which is more; infinity where they gained no less.
    Row to_come() const {
        const auto middle = gains_.end() - static_cast<std::ptrdiff_t>(delay);
        Row recent = std::accumulate(middle, gains_.end(), Row(Row::Zero())).max(0.0);
        const Row before = std::accumulate(gains_.begin(), middle, Row(Row::Zero()));
        if (gains_.size() < 2 * delay) {
            return recent;
        }
        const Row rest = (recent < before).select(recent / (before - recent), std::numeric_limits<double>::infinity());
        return recent * rest.max(1.0);
    }

    Row affine_energy_;
    std::deque<Row> gains_;
    Row total_ = Row::Zero();
    Row estimate_ = Row::Constant(std::numeric_limits<double>::infinity());
};

}  // namespace coagula::mechanics
