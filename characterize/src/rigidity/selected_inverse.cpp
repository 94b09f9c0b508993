// SPDX-License-Identifier: GPL-3.0-or-later
#include "selected_inverse.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

extern "C" {
// BLAS, columns first. NOLINTBEGIN(readability-identifier-naming)
void dgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n, const int* k, const double* alpha,
            const double* a, const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
void dsymm_(const char* side, const char* triangle, const int* m, const int* n, const double* alpha, const double* a,
            const int* lda, const double* b, const int* ldb, const double* beta, double* c, const int* ldc);
void dtrsm_(const char* side, const char* triangle, const char* transpose, const char* unit, const int* m, const int* n,
            const double* alpha, const double* a, const int* lda, double* b, const int* ldb);
// NOLINTEND(readability-identifier-naming)
}

namespace coagula::characterize {

namespace {

constexpr double zero = 0;
constexpr double one = 1;
constexpr double minus_one = -1;
constexpr int panel_columns = 192;

std::size_t area(int rows, int columns) {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
}

}  // namespace

SelectedInverse::SelectedInverse(const CholeskyFactor& factor) {
    std::vector<const double*> value;
    factor.for_each_supernode([&](const CholeskyFactor::SupernodeView& view) { value.push_back(view.value); });
    copy_pattern(factor);
    std::vector<double> scratch;
    for (std::size_t k = nodes_.size(); k-- > 0;) {
        invert(nodes_[k], value[k], scratch);
    }
}

void SelectedInverse::copy_pattern(const CholeskyFactor& factor) {
    std::size_t values = 0;
    factor.for_each_supernode([&](const CholeskyFactor::SupernodeView& view) {
        node_of_.insert(node_of_.end(), static_cast<std::size_t>(view.columns), static_cast<int>(nodes_.size()));
        nodes_.push_back({view.first_column, view.columns, view.rows, rows_.size(), values});
        rows_.insert(rows_.end(), view.row, view.row + view.rows);
        values += area(view.rows, view.columns);
    });
    values_.assign(values, 0.0);
    const std::vector<int> permutation = factor.permutation();
    place_of_.resize(permutation.size());
    for (std::size_t k = 0; k < permutation.size(); ++k) {
        place_of_[static_cast<std::size_t>(permutation[k])] = static_cast<int>(k);
    }
}

/// Columns are taken in panels from the last to the first, so that a wide node costs no more than its share of the factor times
/// two.
/// @param scratch for Z_RR, and Y and L_JJ^-1 of a panel.
void SelectedInverse::invert(const Node& node, const double* factor, std::vector<double>& scratch) {
    const int below = node.rows - node.columns;
    const auto panel = static_cast<std::size_t>(panel_columns);
    const std::size_t needed = area(below, below) + area(node.rows, panel_columns) + panel * panel;
    scratch.resize(std::max(scratch.size(), needed));
    gather(node, scratch.data());
    for (int end = node.columns; end > 0;) {
        const int begin = (end - 1) / panel_columns * panel_columns;
        invert_panel(node, begin, end, factor, scratch);
        end = begin;
    }
}

/// The rows below the panel are K, the node's later columns, and R: Z_KJ = -(Z_KK Y_K + Z_RK^T Y_R), Z_RJ = -(Z_RK Y_K + Z_RR Y_R).
void SelectedInverse::invert_panel(const Node& node, int begin, int end, const double* factor, std::vector<double>& scratch) {
    const int ld = node.rows;
    const int n = end - begin;
    const int later = node.columns - end;
    const int below = node.rows - node.columns;
    const int rest = later + below;
    const double* ancestors = scratch.data();
    double* y = scratch.data() + area(below, below);
    double* inverse = y + area(node.rows, panel_columns);
    const double* l = factor + area(ld, begin) + begin;
    double* z = values_.data() + node.value_start + area(ld, begin) + begin;

    std::fill(inverse, inverse + area(n, n), 0.0);
    for (int k = 0; k < n; ++k) {
        inverse[area(n + 1, k)] = 1;
        std::copy_n(l + area(ld, k) + n, rest, y + area(rest, k));
    }
    dtrsm_("L", "L", "N", "N", &n, &n, &one, l, &ld, inverse, &n);
    dgemm_("T", "N", &n, &n, &n, &one, inverse, &n, inverse, &n, &zero, z, &ld);
    if (rest == 0) {
        return;
    }
    dtrsm_("R", "L", "N", "N", &rest, &n, &one, l, &ld, y, &rest);
    double* z_k = z + n;
    double* z_r = z_k + later;
    const double* y_r = y + later;
    if (below > 0) {
        dsymm_("L", "L", &below, &n, &minus_one, ancestors, &below, y_r, &rest, &zero, z_r, &ld);
    }
    if (later > 0) {
        const double* z_kk = z + area(ld, n) + n;
        const double* z_rk = z_kk + later;
        dsymm_("L", "L", &later, &n, &minus_one, z_kk, &ld, y, &rest, &zero, z_k, &ld);
        if (below > 0) {
            dgemm_("T", "N", &later, &n, &below, &minus_one, z_rk, &ld, y_r, &rest, &one, z_k, &ld);
            dgemm_("N", "N", &below, &n, &later, &minus_one, z_rk, &ld, y, &rest, &one, z_r, &ld);
        }
    }
    dgemm_("T", "N", &n, &n, &rest, &minus_one, y, &rest, z_k, &ld, &one, z, &ld);
}

/// Lower triangle of Z_RR: every row of R below the first is in the pattern of the columns of R before it.
void SelectedInverse::gather(const Node& node, double* below) const {
    const int count = node.rows - node.columns;
    const int* row = rows_.data() + node.row_start + node.columns;
    std::vector<int> position(static_cast<std::size_t>(count));
    for (int begin = 0; begin < count;) {
        const Node& above = nodes_[static_cast<std::size_t>(node_of_[static_cast<std::size_t>(row[begin])])];
        const int* where = rows_.data() + above.row_start;
        for (int k = begin, p = 0; k < count; ++k) {
            while (p < above.rows && where[p] != row[k]) {
                ++p;
            }
            position[static_cast<std::size_t>(k)] = p;
        }
        if (position[static_cast<std::size_t>(count) - 1] == above.rows) {
            throw std::logic_error("the pattern of a Cholesky factor is not closed under elimination");
        }
        int column = begin;
        for (; column < count && row[column] < above.first_column + above.columns; ++column) {
            const double* value = values_.data() + above.value_start + area(above.rows, row[column] - above.first_column);
            for (int k = column; k < count; ++k) {
                below[area(count, column) + static_cast<std::size_t>(k)] = value[position[static_cast<std::size_t>(k)]];
            }
        }
        begin = column;
    }
}

double SelectedInverse::operator()(int i, int j) const {
    int row = place_of_[static_cast<std::size_t>(i)];
    int column = place_of_[static_cast<std::size_t>(j)];
    if (row < column) {
        std::swap(row, column);
    }
    const Node& node = nodes_[static_cast<std::size_t>(node_of_[static_cast<std::size_t>(column)])];
    const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(node.row_start);
    const auto found = std::lower_bound(begin, begin + node.rows, row);
    if (found == begin + node.rows || *found != row) {
        throw std::logic_error("this entry of the inverse is not among those that were found");
    }
    return values_[node.value_start + area(node.rows, column - node.first_column) + static_cast<std::size_t>(found - begin)];
}

}  // namespace coagula::characterize
