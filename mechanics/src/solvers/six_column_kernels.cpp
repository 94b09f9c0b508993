// SPDX-License-Identifier: GPL-3.0-or-later
#include "six_column_kernels.hpp"

#include <coagula/common/vector_variants.hpp>

namespace coagula::mechanics {

namespace {

// std::array would drop the attributes of these vectors.
// NOLINTBEGIN(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)

// Vectors of the compiler, which it splits where the processor has shorter ones; they may stand anywhere and alias plain numbers.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));
using Two = double __attribute__((vector_size(16), aligned(8), may_alias));
using Eight = float __attribute__((vector_size(32), aligned(32), may_alias));

COAGULA_INLINE Eight& as_vector(PaddedRow& row) {
    return *reinterpret_cast<Eight*>(row.value.data());  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

COAGULA_INLINE const Eight& as_vector(const PaddedRow& row) {
    return *reinterpret_cast<const Eight*>(row.value.data());  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

/// Takes `Count` rows below the diagonal block at once, so that no sum waits for another.
template <int Count>
COAGULA_INLINE void subtract_from_rows(const SupernodeValues& node, int first, const PaddedRow* own, PaddedRow* all) {
    const float* value = node.below + static_cast<std::ptrdiff_t>(first) * node.columns;
    Eight sum[Count] = {};
    for (int column = 0; column < node.columns; ++column) {
        const Eight known = as_vector(own[column]);
        for (int row = 0; row < Count; ++row) {
            sum[row] += value[row * node.columns + column] * known;
        }
    }
    for (int row = 0; row < Count; ++row) {
        as_vector(all[node.row[first + row]]) -= sum[row];
    }
}

/// Takes `Count` columns at once and keeps their sums in registers.
template <int Count>
COAGULA_INLINE void subtract_from_columns(const SupernodeValues& node, int first, PaddedRow* own, const PaddedRow* all) {
    const float* value = node.below + first;
    Eight sum[Count] = {};
    for (int row = 0; row < node.rows; ++row, value += node.columns) {
        const Eight known = as_vector(all[node.row[row]]);
        for (int column = 0; column < Count; ++column) {
            sum[column] += value[column] * known;
        }
    }
    for (int column = 0; column < Count; ++column) {
        as_vector(own[first + column]) -= sum[column];
    }
}

}  // namespace

COAGULA_VARIANTS void multiply_row(const double* block, const std::ptrdiff_t* column, std::size_t blocks, const double* x,
                                   double* sum) {
    Four left[6] = {};
    Two right[6] = {};
    for (std::size_t k = 0; k < blocks; ++k, block += 36) {
        const double* other = x + 36 * column[k];
        for (int c = 0; c < 6; ++c, other += 6) {
            const Four known_left = *reinterpret_cast<const Four*>(other);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
            const Two known_right =
                *reinterpret_cast<const Two*>(other + 4);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
            for (int r = 0; r < 6; ++r) {
                left[r] += block[6 * c + r] * known_left;
                right[r] += block[6 * c + r] * known_right;
            }
        }
    }
    for (std::ptrdiff_t r = 0; r < 6; ++r) {
        *reinterpret_cast<Four*>(sum + 6 * r) = left[r];      // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
        *reinterpret_cast<Two*>(sum + 6 * r + 4) = right[r];  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
    }
}

COAGULA_VARIANTS void solve_forward(const SupernodeValues& node, PaddedRow* own, PaddedRow* all) {
    for (int column = 0; column < node.columns; ++column) {
        as_vector(own[column]) *= node.diagonal[column * node.columns + column];
        const Eight known = as_vector(own[column]);
        for (int row = column + 1; row < node.columns; ++row) {
            as_vector(own[row]) -= node.diagonal[row * node.columns + column] * known;
        }
    }
    int row = 0;
    for (; row + 6 <= node.rows; row += 6) {
        subtract_from_rows<6>(node, row, own, all);
    }
    for (; row < node.rows; ++row) {
        subtract_from_rows<1>(node, row, own, all);
    }
}

COAGULA_VARIANTS void solve_backward(const SupernodeValues& node, PaddedRow* own, const PaddedRow* all) {
    int column = 0;
    for (; column + 6 <= node.columns; column += 6) {
        subtract_from_columns<6>(node, column, own, all);
    }
    for (; column < node.columns; ++column) {
        subtract_from_columns<1>(node, column, own, all);
    }
    for (int row = node.columns - 1; row >= 0; --row) {
        const float* value = node.diagonal + static_cast<std::ptrdiff_t>(row) * node.columns;
        as_vector(own[row]) *= value[row];
        const Eight known = as_vector(own[row]);
        for (int other = 0; other < row; ++other) {
            as_vector(own[other]) -= value[other] * known;
        }
    }
}

// NOLINTEND(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays)

}  // namespace coagula::mechanics
