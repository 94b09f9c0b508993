#include "cholesky_factor.hpp"

#include <cholmod.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

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
    void check(const char* what) {
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

/// Lower triangle by columns (CHOLMOD stype -1) with one entry per block: the graph of the particles.
Sparse block_pattern(const BlockMatrix& upper, Common& common) {
    const auto rows = static_cast<std::size_t>(upper.rows());
    Sparse pattern(cholmod_allocate_sparse(rows, rows, upper.column.size(), 1, 1, -1, CHOLMOD_PATTERN, common), {&common});
    common.check("allocating the graph of the network");
    auto* start = static_cast<int*>(pattern->p);
    auto* index = static_cast<int*>(pattern->i);
    for (std::size_t row = 0; row <= rows; ++row) {
        start[row] = static_cast<int>(upper.start[row]);
    }
    for (std::size_t k = 0; k < upper.column.size(); ++k) {
        index[k] = static_cast<int>(upper.column[k]);
    }
    return pattern;
}

/// Lower triangle by columns of K + shift I. Row r of the upper triangle is column r of the lower one.
Sparse scalar_matrix(const BlockMatrix& upper, double shift, Common& common) {
    const auto rows = static_cast<std::size_t>(upper.rows());
    const std::size_t entries = 36 * upper.column.size() - 15 * rows;
    if (entries > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw std::runtime_error("the network is too large for the direct solver; choose the iterative one");
    }
    Sparse matrix(cholmod_allocate_sparse(6 * rows, 6 * rows, entries, 1, 1, -1, CHOLMOD_REAL, common), {&common});
    common.check("allocating the stiffness matrix");
    auto* start = static_cast<int*>(matrix->p);
    auto* index = static_cast<int*>(matrix->i);
    auto* value = static_cast<double*>(matrix->x);
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

}  // namespace

EliminationOrder::EliminationOrder(const BlockMatrix& upper, Ordering ordering) {
    Common common;
    common->nmethods = 1;
    common->method[0].ordering = ordering == Ordering::minimum_degree ? CHOLMOD_AMD : CHOLMOD_METIS;
    common->postorder = 1;
    const Sparse pattern = block_pattern(upper, common);
    const Factor factor(cholmod_analyze(pattern.get(), common), {&common});
    common.check("ordering the stiffness matrix");
    const auto* order = static_cast<const int*>(factor->Perm);
    const auto* count = static_cast<const int*>(factor->ColCount);
    permutation_.reserve(6 * factor->n);
    for (std::size_t k = 0; k < factor->n; ++k) {
        predicted_memory_ += 8.0 * 36.0 * static_cast<double>(count[k]);
        for (int component = 0; component < 6; ++component) {
            permutation_.push_back(6 * order[k] + component);
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

CholeskyFactor::CholeskyFactor(const BlockMatrix& upper, double shift, const EliminationOrder& order)
    : implementation_(std::make_unique<Implementation>()) {
    Common& common = implementation_->common;
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = 0;
    const Sparse matrix = scalar_matrix(upper, shift, common);
    auto permutation = order.permutation();
    implementation_->factor = Factor(cholmod_analyze_p(matrix.get(), permutation.data(), nullptr, 0, common), {&common});
    common.check("analysing the stiffness matrix");
    cholmod_factorize(matrix.get(), implementation_->factor.get(), common);
    common.check("factorising the stiffness matrix");
}

CholeskyFactor::~CholeskyFactor() = default;

void CholeskyFactor::solve(const Loads& b, Loads& x) const {
    x = implementation_->solve(b);
}

void CholeskyFactor::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const {
    x = implementation_->solve(b);
}

void CholeskyFactor::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
    x = implementation_->solve(b);
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

}  // namespace coagula::mechanics
