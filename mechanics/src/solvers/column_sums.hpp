// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on six columns at once that both gradient solvers need; the same bits for any number of threads.
#pragma once

#include <coagula/common/parallel.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace coagula::mechanics {

/// Symmetry cancels the forces of a load. What is left of them, over their norm before, is a rounding error below this.
inline constexpr double rounding_of_loads = 1e-13;
/// Residuals are relative to a load of at least this. Where symmetry cancels a load down to the digits of a file, its sum, which no
/// stiffness resists, is a rounding error that counts beside the rest.
inline constexpr double least_load = 1e-5;

template <class Value>
using SixColumns = Eigen::Matrix<Value, Eigen::Dynamic, 6, Eigen::RowMajor>;
template <class Value>
using SixValues = Eigen::Array<Value, 1, 6>;

/// Column-wise sums of `term(first row, rows)`, itself a sum over these rows; in fixed pieces.
template <class Value, class Term>
SixValues<Value> sum_of_pieces(Eigen::Index rows, const Term& term) {
    constexpr Eigen::Index piece = 4096;
    const Eigen::Index pieces = (rows + piece - 1) / piece;
    Eigen::Array<Value, Eigen::Dynamic, 6, Eigen::RowMajor> part(pieces, 6);
#pragma omp parallel for schedule(static) if (worth_threads(rows, 5))
    for (Eigen::Index k = 0; k < pieces; ++k) {
        part.row(k) = term(k * piece, std::min(piece, rows - k * piece));
    }
    return part.colwise().sum();
}

/// Column-wise a . b, without conjugation.
template <class Value>
SixValues<Value> dot(const SixColumns<Value>& a, const SixColumns<Value>& b) {
    return sum_of_pieces<Value>(a.rows(), [&](Eigen::Index first, Eigen::Index rows) -> SixValues<Value> {
        return (a.middleRows(first, rows).array() * b.middleRows(first, rows).array()).colwise().sum();
    });
}

/// a += b * factor, column by column.
template <class Value>
void add_scaled(SixColumns<Value>& a, const SixColumns<Value>& b, const std::type_identity_t<SixValues<Value>>& factor) {
#pragma omp parallel for schedule(static) if (worth_threads(a.rows(), 5))
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
        a.row(row).array() += b.row(row).array() * factor;
    }
}

/// a = b + a * factor, column by column.
template <class Value>
void scale_and_add(SixColumns<Value>& a, const std::type_identity_t<SixValues<Value>>& factor, const SixColumns<Value>& b) {
#pragma omp parallel for schedule(static) if (worth_threads(a.rows(), 5))
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
        a.row(row).array() = b.row(row).array() + a.row(row).array() * factor;
    }
}

using SixBySix = Eigen::Matrix<double, 6, 6>;

/// a^T b; in fixed pieces.
inline SixBySix products(const SixColumns<double>& a, const SixColumns<double>& b) {
    constexpr Eigen::Index piece = 4096;
    const Eigen::Index pieces = (a.rows() + piece - 1) / piece;
    std::vector<SixBySix> part(static_cast<std::size_t>(pieces));
#pragma omp parallel for schedule(static) if (worth_threads(a.rows(), 20))
    for (Eigen::Index k = 0; k < pieces; ++k) {
        const Eigen::Index rows = std::min(piece, a.rows() - k * piece);
        SixBySix sum = SixBySix::Zero();
        for (Eigen::Index row = k * piece; row < k * piece + rows; ++row) {
            sum.noalias() += a.row(row).transpose() * b.row(row);
        }
        part[static_cast<std::size_t>(k)] = sum;
    }
    return std::accumulate(part.begin(), part.end(), SixBySix(SixBySix::Zero()));
}

/// a += b * factor.
inline void add_product(SixColumns<double>& a, const SixColumns<double>& b, const SixBySix& factor) {
#pragma omp parallel for schedule(static) if (worth_threads(a.rows(), 20))
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
        a.row(row).noalias() += b.row(row) * factor;
    }
}

/// a = b * kept + a * factor.
inline void replace_by_sum(SixColumns<double>& a, const SixBySix& factor, const SixColumns<double>& b,
                           const SixValues<double>& kept) {
#pragma omp parallel for schedule(static) if (worth_threads(a.rows(), 20))
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
        const SixValues<double> sum = b.row(row).array() * kept + (a.row(row) * factor).array();
        a.row(row) = sum.matrix();
    }
}

}  // namespace coagula::mechanics
