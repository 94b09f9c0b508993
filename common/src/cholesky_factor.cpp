// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/cholesky_factor.hpp>

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace coagula {

namespace {

/// cholmod_common with its clean-up.
class Common {
public:
    Common() {
        cholmod_start(&common_);
        common_.print = 0;
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.useGPU = 0;
    }
    ~Common() { cholmod_finish(&common_); }
    Common(const Common&) = delete;
    Common& operator=(const Common&) = delete;

    operator cholmod_common*() { return &common_; }  // NOLINT(google-explicit-constructor)
    cholmod_common* operator->() { return &common_; }

    /// Throws std::runtime_error if the last call failed.
    void check(const char* what) const {
        if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
            throw std::runtime_error(std::string(what) + ": not enough memory for the direct solver; choose the iterative one");
        }
        if (common_.status == CHOLMOD_NOT_POSDEF) {
            throw NotPositiveDefinite(std::string(what) + ": it is not positive definite");
        }
        if (common_.status != CHOLMOD_OK) {
            throw std::runtime_error(std::string(what) + " failed (CHOLMOD status " + std::to_string(common_.status) + ")");
        }
    }

private:
    cholmod_common common_{};
};

/// Keeps CHOLMOD from starting threads of its own, always four, which wait for each other by spinning; those of BLAS remain.
class NoInnerThreads {
public:
    NoInnerThreads() { omp_set_max_active_levels(0); }
    ~NoInnerThreads() { omp_set_max_active_levels(before_); }
    NoInnerThreads(const NoInnerThreads&) = delete;
    NoInnerThreads& operator=(const NoInnerThreads&) = delete;

private:
    int before_ = omp_get_max_active_levels();
};

struct SparseDeleter {
    Common* common;
    void operator()(cholmod_sparse* matrix) const { cholmod_free_sparse(&matrix, *common); }
};
struct FactorDeleter {
    Common* common;
    void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, *common); }
};
struct DenseDeleter {
    Common* common;
    void operator()(cholmod_dense* matrix) const { cholmod_free_dense(&matrix, *common); }
};
using Sparse = std::unique_ptr<cholmod_sparse, SparseDeleter>;
using Factor = std::unique_ptr<cholmod_factor, FactorDeleter>;
using Dense = std::unique_ptr<cholmod_dense, DenseDeleter>;

/// CHOLMOD's stype of a symmetric matrix of which the lower triangle is stored.
constexpr int lower_triangle = -1;

Sparse pattern_of(std::span<const Index> start, std::span<const Index> row, Common& common) {
    const std::size_t columns = start.size() - 1;
    Sparse pattern(cholmod_allocate_sparse(columns, columns, row.size(), 1, 1, lower_triangle, CHOLMOD_PATTERN, common), {&common});
    common.check("allocating the graph of the network");
    std::transform(start.begin(), start.end(), static_cast<int*>(pattern->p), [](Index k) { return static_cast<int>(k); });
    std::transform(row.begin(), row.end(), static_cast<int*>(pattern->i), [](Index k) { return static_cast<int>(k); });
    return pattern;
}

/// CHOLMOD reads these arrays and does not change them.
cholmod_sparse view_of(const Eigen::SparseMatrix<double>& lower) {
    cholmod_sparse view{};
    view.nrow = static_cast<std::size_t>(lower.rows());
    view.ncol = static_cast<std::size_t>(lower.cols());
    view.nzmax = static_cast<std::size_t>(lower.nonZeros());
    view.p = const_cast<int*>(lower.outerIndexPtr());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    view.i = const_cast<int*>(lower.innerIndexPtr());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    view.x = const_cast<double*>(lower.valuePtr());    // NOLINT(cppcoreguidelines-pro-type-const-cast)
    view.stype = lower_triangle;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
}

}  // namespace

EliminationOrder::EliminationOrder(std::span<const Index> start, std::span<const Index> row, int block_size, Ordering ordering) {
    Common common;
    common->nmethods = 1;
    common->method[0].ordering = ordering == Ordering::minimum_degree ? CHOLMOD_AMD : CHOLMOD_METIS;
    common->postorder = 1;
    const Sparse pattern = pattern_of(start, row, common);
    const Factor factor(cholmod_analyze(pattern.get(), common), {&common});
    common.check("ordering the stiffness matrix");
    const auto* order = static_cast<const int*>(factor->Perm);
    const auto* count = static_cast<const int*>(factor->ColCount);
    const double block_entries = static_cast<double>(block_size) * block_size;
    permutation_.reserve(static_cast<std::size_t>(block_size) * factor->n);
    for (std::size_t k = 0; k < factor->n; ++k) {
        predicted_memory_ += 8.0 * block_entries * static_cast<double>(count[k]);
        for (int component = 0; component < block_size; ++component) {
            permutation_.push_back(block_size * order[k] + component);
        }
    }
}

struct CholeskyFactor::Implementation {
    mutable Common common;
    Factor factor{nullptr, {nullptr}};

    Eigen::MatrixXd solve(Eigen::MatrixXd columns) const {
        cholmod_dense view{};
        view.nrow = static_cast<std::size_t>(columns.rows());
        view.ncol = static_cast<std::size_t>(columns.cols());
        view.nzmax = view.nrow * view.ncol;
        view.d = view.nrow;
        view.x = columns.data();
        view.xtype = CHOLMOD_REAL;
        view.dtype = CHOLMOD_DOUBLE;
        const Dense solution(cholmod_solve(CHOLMOD_A, factor.get(), &view, common), {&common});
        common.check("solving with the factor");
        return Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution->x), columns.rows(), columns.cols());
    }
};

CholeskyFactor::CholeskyFactor(const Eigen::SparseMatrix<double>& lower, const EliminationOrder& order)
    : implementation_(std::make_unique<Implementation>()) {
    Common& common = implementation_->common;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = 0;
    cholmod_sparse matrix = view_of(lower);
    auto permutation = order.permutation();
    implementation_->factor = Factor(cholmod_analyze_p(&matrix, permutation.data(), nullptr, 0, common), {&common});
    common.check("analysing the stiffness matrix");
    {
        const NoInnerThreads calm;
        cholmod_factorize(&matrix, implementation_->factor.get(), common);
    }
    common.check("factorising the stiffness matrix");
}

CholeskyFactor::~CholeskyFactor() = default;

Eigen::MatrixXd CholeskyFactor::solve(Eigen::MatrixXd b) const {
    return implementation_->solve(std::move(b));
}

void CholeskyFactor::for_each_supernode(const std::function<void(const SupernodeView&)>& visit) const {
    const cholmod_factor& factor = *implementation_->factor;
    const auto* column = static_cast<const int*>(factor.super);
    const auto* row_start = static_cast<const int*>(factor.pi);
    const auto* value_start = static_cast<const int*>(factor.px);
    const auto* row = static_cast<const int*>(factor.s);
    const auto* value = static_cast<const double*>(factor.x);
    for (std::size_t s = 0; s < factor.nsuper; ++s) {
        visit({column[s], column[s + 1] - column[s], row_start[s + 1] - row_start[s], row + row_start[s], value + value_start[s]});
    }
}

std::vector<int> CholeskyFactor::permutation() const {
    const cholmod_factor& factor = *implementation_->factor;
    const auto* permutation = static_cast<const int*>(factor.Perm);
    return {permutation, permutation + factor.n};
}

Index CholeskyFactor::pivots_below(double threshold) const {
    Index count = 0;
    for_each_supernode([&](const SupernodeView& node) {
        for (int column = 0; column < node.columns; ++column) {
            const double pivot = node.value[static_cast<std::ptrdiff_t>(column) * node.rows + column];
            count += pivot * pivot < threshold ? 1 : 0;
        }
    });
    return count;
}

}  // namespace coagula
