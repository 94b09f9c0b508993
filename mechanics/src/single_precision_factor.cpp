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

void SinglePrecisionFactor::forward(std::vector<Row>& x) const {
    for (const Supernode& node : supernodes_) {
        const float* value = values_.data() + node.values_start;
        Row* own = x.data() + node.first_column;
        for (int row = 0; row < node.columns; ++row, value += node.columns) {
            Row sum = own[row];
            for (int column = 0; column < row; ++column) {
                sum -= value[column] * own[column];
            }
            own[row] = sum * value[row];
        }
        for (int row = 0; row < node.rows; ++row, value += node.columns) {
            Row sum = Row::Zero();
            for (int column = 0; column < node.columns; ++column) {
                sum += value[column] * own[column];
            }
            x[static_cast<std::size_t>(rows_[node.rows_start + static_cast<std::size_t>(row)])] -= sum;
        }
    }
}

void SinglePrecisionFactor::backward(std::vector<Row>& x) const {
    for (auto node = supernodes_.rbegin(); node != supernodes_.rend(); ++node) {
        const auto columns = static_cast<std::size_t>(node->columns);
        const float* diagonal = values_.data() + node->values_start;
        const float* below = diagonal + columns * columns;
        Row* own = x.data() + node->first_column;
        for (int row = 0; row < node->rows; ++row, below += columns) {
            const Row other = x[static_cast<std::size_t>(rows_[node->rows_start + static_cast<std::size_t>(row)])];
            for (std::size_t column = 0; column < columns; ++column) {
                own[column] -= below[column] * other;
            }
        }
        for (std::size_t row = columns; row-- > 0;) {
            const float* value = diagonal + row * columns;
            own[row] *= value[row];
            for (std::size_t column = 0; column < row; ++column) {
                own[column] -= value[column] * own[row];
            }
        }
    }
}

void SinglePrecisionFactor::solve(const Loads& b, Loads& x) const {
    std::vector<Row> work(permutation_.size(), Row::Zero());
    for (std::size_t k = 0; k < work.size(); ++k) {
        work[k].head<6>() = b.row(permutation_[k]).transpose().cast<float>().array();
    }
    forward(work);
    backward(work);
    x.resize(b.rows(), 6);
    for (std::size_t k = 0; k < work.size(); ++k) {
        x.row(permutation_[k]) = work[k].head<6>().cast<double>().matrix().transpose();
    }
}

}  // namespace coagula::mechanics
