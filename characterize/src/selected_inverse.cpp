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

/// @param scratch for Y, Z_RR and L_JJ^-1.
void SelectedInverse::invert(const Node& node, const double* factor, std::vector<double>& scratch) {
    const int n = node.columns;
    const int below = node.rows - n;
    scratch.resize(std::max(scratch.size(), area(below, n) + area(below, below) + area(n, n)));
    double* y = scratch.data();
    double* ancestors = y + area(below, n);
    double* inverse = ancestors + area(below, below);
    double* z = values_.data() + node.value_start;

    std::fill(inverse, inverse + area(n, n), 0.0);
    for (int k = 0; k < n; ++k) {
        inverse[area(n + 1, k)] = 1;
    }
    dtrsm_("L", "L", "N", "N", &n, &n, &one, factor, &node.rows, inverse, &n);
    dgemm_("T", "N", &n, &n, &n, &one, inverse, &n, inverse, &n, &zero, z, &node.rows);
    if (below == 0) {
        return;
    }
    for (int k = 0; k < n; ++k) {
        std::copy_n(factor + area(node.rows, k) + n, below, y + area(below, k));
    }
    dtrsm_("R", "L", "N", "N", &below, &n, &one, factor, &node.rows, y, &below);
    gather(node, ancestors);
    dsymm_("L", "L", &below, &n, &minus_one, ancestors, &below, y, &below, &zero, z + n, &node.rows);
    dgemm_("T", "N", &n, &n, &below, &minus_one, y, &below, z + n, &node.rows, &one, z, &node.rows);
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
