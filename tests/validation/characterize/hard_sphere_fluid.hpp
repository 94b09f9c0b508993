// SPDX-License-Identifier: GPL-3.0-or-later
// A hard-sphere fluid at volume fraction 0.4, equilibrated by Metropolis Monte Carlo, and means over its configurations.
#pragma once

#include "unit/characterize/test_packings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::characterize::test {

inline constexpr double fluid_fraction = 0.4;

/// Spheres of diameter 1 that are moved one by one, unless they would overlap.
class Fluid {
public:
    Fluid() : packing_(face_centred({6, 6, 6}, 0.5)) {
        const double stretch = std::cbrt(std::numbers::pi / (3 * std::sqrt(2.0)) / fluid_fraction);
        packing_.cell = Cell::periodic(stretch * packing_.cell.lengths());
        packing_.positions *= stretch;
        edge_ = packing_.cell.lengths()[0];
        boxes_ = static_cast<int>(edge_);  // no smaller than a diameter
        inside_.resize(static_cast<std::size_t>(Index{boxes_} * boxes_ * boxes_));
        for (Index i = 0; i < packing_.size(); ++i) {
            inside_[box_of(packing_.positions.col(i))].push_back(i);
        }
    }

    const Packing& packing() const { return packing_; }

    void sweep(int times) {
        for (int sweep = 0; sweep < times; ++sweep, ++step_) {
            for (Index i = 0; i < packing_.size(); ++i) {
                const Eigen::Vector3d shift =
                    random_uniform(1, RandomPurpose::test, step_, static_cast<std::uint64_t>(i)).array() - 0.5;
                try_move(i, packing_.cell.wrap(packing_.positions.col(i) + 0.3 * shift));
            }
        }
    }

private:
    void try_move(Index i, const Eigen::Vector3d& place) {
        const Eigen::Array3i home = (place / edge_ * boxes_).cast<int>().array().min(boxes_ - 1);
        for (int k = 0; k < 27; ++k) {
            const Eigen::Array3i box = home + Eigen::Array3i(k % 3, k / 3 % 3, k / 9) - 1;
            for (const Index j : inside_[slot(box)]) {
                if (j != i && packing_.cell.minimum_image(packing_.positions.col(j) - place).squaredNorm() < 1) {
                    return;
                }
            }
        }
        std::erase(inside_[box_of(packing_.positions.col(i))], i);
        packing_.positions.col(i) = place;
        inside_[box_of(place)].push_back(i);
    }

    std::size_t slot(const Eigen::Array3i& box) const {
        const Eigen::Array3i inside = box.unaryExpr([this](int k) { return (k + boxes_) % boxes_; });
        return static_cast<std::size_t>((Index{inside[2]} * boxes_ + inside[1]) * boxes_ + inside[0]);
    }
    std::size_t box_of(const Eigen::Vector3d& place) const {
        return slot((place / edge_ * boxes_).cast<int>().array().min(boxes_ - 1));
    }

    Packing packing_;
    double edge_;
    int boxes_;
    std::vector<std::vector<Index>> inside_;
    std::uint64_t step_ = 0;
};

/// Mean over configurations and its standard error.
struct Average {
    double sum = 0, squares = 0, count = 0;
    void add(double value) {
        sum += value;
        squares += value * value;
        count += 1;
    }
    double mean() const { return sum / count; }
    double error() const { return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / (count - 1)); }
};

}  // namespace coagula::characterize::test
