// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of the inverse of a sparse matrix where its Cholesky factor has entries.
#pragma once

#include <coagula/common/cholesky_factor.hpp>

#include <cstddef>
#include <vector>

namespace coagula::characterize {

/// The inverse Z follows from the last supernode to the first by the recurrence of Takahashi, Fagan and Chin (1973), in blocks:
/// with the factor's columns J and the rows R below them, Y = L_RJ L_JJ^-1, Z_RJ = -Z_RR Y, Z_JJ = (L_JJ L_JJ^T)^-1 - Y^T Z_RJ. It
/// is exact and takes about twice the work of the factorisation and the memory of the factor.
class SelectedInverse {
public:
    explicit SelectedInverse(const CholeskyFactor& factor);

    /// (A^-1)_ij. Throws std::logic_error where the factor has no entry; it has one wherever A has one.
    double operator()(int i, int j) const;

private:
    struct Node {
        int first_column;
        int columns;
        int rows;                 ///< the columns' own first
        std::size_t row_start;    ///< in rows_
        std::size_t value_start;  ///< in values_, rows x columns
    };

    void copy_pattern(const CholeskyFactor& factor);
    void invert(const Node& node, const double* factor, std::vector<double>& scratch);
    void invert_panel(const Node& node, int begin, int end, const double* factor, std::vector<double>& scratch);
    void gather(const Node& node, double* below) const;

    std::vector<Node> nodes_;
    std::vector<int> node_of_;   ///< of every eliminated column
    std::vector<int> place_of_;  ///< of every row of A in the order of elimination
    std::vector<int> rows_;
    std::vector<double> values_;
};

}  // namespace coagula::characterize
