// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_factor.hpp"

#include <limits>
#include <stdexcept>

namespace coagula::mechanics {

EliminationOrder elimination_order(const BlockMatrix& upper, Ordering ordering) {
    return {upper.start, upper.column, 6, ordering};  // row r of the upper triangle is column r of the lower one
}

Eigen::SparseMatrix<double> shifted(const BlockMatrix& upper, double shift) {
    const auto rows = static_cast<std::size_t>(upper.rows());
    const std::size_t entries = 36 * upper.column.size() - 15 * rows;
    if (entries > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw std::runtime_error("the network is too large for the direct solver; choose the iterative one");
    }
    Eigen::SparseMatrix<double> matrix(6 * upper.rows(), 6 * upper.rows());
    matrix.resizeNonZeros(static_cast<Index>(entries));
    int* start = matrix.outerIndexPtr();
    int* index = matrix.innerIndexPtr();
    double* value = matrix.valuePtr();
    int place = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        for (int c = 0; c < 6; ++c) {
            start[6 * row + static_cast<std::size_t>(c)] = place;
            for (auto k = static_cast<std::size_t>(upper.start[row]); k < static_cast<std::size_t>(upper.start[row + 1]); ++k) {
                const bool diagonal = static_cast<std::size_t>(upper.column[k]) == row;
                for (int r = diagonal ? c : 0; r < 6; ++r) {
                    index[place] = static_cast<int>(6 * upper.column[k]) + r;
                    value[place++] = upper.block[k](c, r) + (diagonal && r == c ? shift : 0.0);
                }
            }
        }
    }
    start[6 * rows] = place;
    return matrix;
}

}  // namespace coagula::mechanics
