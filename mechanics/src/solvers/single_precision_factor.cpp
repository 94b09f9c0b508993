// SPDX-License-Identifier: GPL-3.0-or-later
#include "single_precision_factor.hpp"

#include "block_factor.hpp"

namespace coagula::mechanics {

SinglePrecisionFactor::SinglePrecisionFactor(const BlockMatrix& upper, double shift, const EliminationOrder& order) {
    const CholeskyFactor factor(shifted(upper, shift), order);
    permutation_ = factor.permutation();
    factor.for_each_supernode([&](const CholeskyFactor::SupernodeView& node) {
        supernodes_.push_back({node.first_column, node.columns, rows_.size(), node.rows - node.columns, values_.size()});
        rows_.insert(rows_.end(), node.row + node.columns, node.row + node.rows);
        for (int row = 0; row < node.rows; ++row) {
            for (int column = 0; column < node.columns; ++column) {
                const double value = node.value[static_cast<std::size_t>(column) * static_cast<std::size_t>(node.rows) +
                                                static_cast<std::size_t>(row)];
                values_.push_back(static_cast<float>(row == column ? 1 / value : value));  // diagonal: inverse
            }
        }
    });
    values_.shrink_to_fit();
}

SupernodeValues SinglePrecisionFactor::values_of(const Supernode& node) const {
    const float* diagonal = values_.data() + node.values_start;
    return {.diagonal = diagonal,
            .below = diagonal + static_cast<std::size_t>(node.columns) * static_cast<std::size_t>(node.columns),
            .columns = node.columns,
            .rows = node.rows,
            .row = rows_.data() + node.rows_start};
}

std::vector<Index> SinglePrecisionFactor::order() const {
    std::vector<Index> particles;
    for (std::size_t row = 0; row < permutation_.size(); row += 6) {
        particles.push_back(permutation_[row] / 6);  // the six rows of a particle stay together
    }
    return particles;
}

void SinglePrecisionFactor::solve(std::vector<PaddedRow>& b) const {
    for (const Supernode& node : supernodes_) {
        solve_forward(values_of(node), b.data() + node.first_column, b.data());
    }
    for (auto node = supernodes_.rbegin(); node != supernodes_.rend(); ++node) {
        solve_backward(values_of(*node), b.data() + node->first_column, b.data());
    }
}

}  // namespace coagula::mechanics
