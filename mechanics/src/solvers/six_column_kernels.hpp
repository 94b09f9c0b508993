// SPDX-License-Identifier: GPL-3.0-or-later
// The inner loops of the linear solver on six columns at once, compiled for several kinds of processor with the same bits.
#pragma once

#include <array>
#include <cstddef>

namespace coagula::mechanics {

/// A row of six numbers in single precision, padded to whole vector registers.
struct alignas(32) PaddedRow {
    std::array<float, 8> value;
};

/// One supernode of a Cholesky factor in single precision.
struct SupernodeValues {
    const float* diagonal;  ///< columns x columns, each row contiguous, the diagonal inverted
    const float* below;     ///< rows x columns, each row contiguous
    int columns;
    int rows;
    const int* row;  ///< place of each row below
};

/// sum += block * x for blocks of 6 x 6 (by columns) and rows of six: `blocks` blocks side by side in one row of the matrix.
/// @param column of each block. @param x six rows of six for each column of blocks. @param sum six rows of six, overwritten.
void multiply_row(const double* block, const std::ptrdiff_t* column, std::size_t blocks, const double* x, double* sum);

/// Solves with the rows of L that the supernode holds: `own` are its rows of the right side, `all` those of the whole matrix.
void solve_forward(const SupernodeValues& node, PaddedRow* own, PaddedRow* all);

/// Solves with the rows of L^T that the supernode holds.
void solve_backward(const SupernodeValues& node, PaddedRow* own, const PaddedRow* all);

}  // namespace coagula::mechanics
