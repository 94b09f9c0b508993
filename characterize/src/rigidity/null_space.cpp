// SPDX-License-Identifier: GPL-3.0-or-later
#include "null_space.hpp"

#include <coagula/common/dense.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <string>

namespace coagula::characterize {

namespace {

constexpr double first_shift = 1e-12;     // of the factor that names the candidates; stiffness of a contact is 1
constexpr double first_threshold = 1e-5;  // pivots below it make a candidate
constexpr double last_threshold = 1e-1;
constexpr Index most_sought = 64;  // motions for which the best unknowns are sought, instead of those with small pivots
constexpr int shifted_iterations = 2;
constexpr double no_strain = 1e-8;  // |A x| of unit motions; exactly floppy ones come out near 1e-15
constexpr int first_sketch = 16;    // random combinations that decide the rank
constexpr int last_sketch = 256;
constexpr int refinements = 2;
constexpr int inverse_iterations = 4;
constexpr int inverse_vectors = 12;
constexpr int most_exchanges = 8;
constexpr double harmless = 2e-5;  // singular values above it do not harm

/// What random numbers are drawn for; different ones never share a number.
enum class Draw : std::uint64_t { sketch, inverse_iteration, motions };

Eigen::MatrixXd random_matrix(Index rows, Index columns, Draw draw, std::uint64_t seed) {
    Eigen::MatrixXd matrix(rows, columns);
    for (Index column = 0; column < columns; ++column) {
        const auto step = 8 * static_cast<std::uint64_t>(column) + static_cast<std::uint64_t>(draw);
        for (Index row = 0; row < rows; row += 3) {
            const Eigen::Vector3d three =
                random_normal(seed, RandomPurpose::floppy_motion, step, static_cast<std::uint64_t>(row / 3));
            const Index count = std::min<Index>(3, rows - row);
            matrix.col(column).segment(row, count) = three.head(count);
        }
    }
    return matrix;
}

/// Keeps the rows of the pinned unknowns, or of the others; the rest becomes zero.
Eigen::MatrixXd rows_where(Eigen::MatrixXd matrix, const std::vector<bool>& pinned, bool keep_pinned) {
    for (Index row = 0; row < matrix.rows(); ++row) {
        if (pinned[static_cast<std::size_t>(row)] != keep_pinned) {
            matrix.row(row).setZero();
        }
    }
    return matrix;
}

double largest_ratio(const Eigen::MatrixXd& numerator, const Eigen::MatrixXd& denominator) {
    return denominator.cols() == 0 ? 0.0 : (numerator.colwise().norm().array() / denominator.colwise().norm().array()).maxCoeff();
}

/// The smallest singular values of the columns that are not pinned and their vectors, by inverse iteration.
struct SoftMotions {
    Eigen::VectorXd value;    ///< descending
    Eigen::MatrixXd vectors;  ///< unit columns

    double smallest() const { return value.size() > 0 ? value[value.size() - 1] : unset; }
};

SoftMotions softest(const SparseMap& matrix, const NullSpace& space, std::uint64_t seed) {
    const Index free = std::count(space.pinned.begin(), space.pinned.end(), false);
    const Index count = std::min<Index>(inverse_vectors, free);
    Eigen::MatrixXd x = rows_where(random_matrix(matrix.unknowns(), count, Draw::inverse_iteration, seed), space.pinned, false);
    for (int k = 0; k < inverse_iterations; ++k) {
        x = dense::orthonormal(space.factor->solve(x));
    }
    const dense::SingularValues strains(matrix.apply(x), dense::SingularValues::Vectors::right);
    return {strains.values, x * strains.vectors};
}

/// Chooses as many unknowns as `vectors` has columns: those whose rows span the vectors best.
/// @param choose whether to choose among the pinned unknowns or among the others.
std::vector<Index> spanning_unknowns(const Eigen::MatrixXd& vectors, const std::vector<bool>& pinned, bool choose) {
    std::vector<Index> candidate;
    for (Index k = 0; k < vectors.rows(); ++k) {
        if (pinned[static_cast<std::size_t>(k)] == choose) {
            candidate.push_back(k);
        }
    }
    const Eigen::MatrixXd rows = vectors(candidate, Eigen::all).transpose();
    const Eigen::VectorXi best = dense::PivotedQr(rows).order;
    std::vector<Index> chosen;
    for (Index k = 0; k < vectors.cols(); ++k) {
        chosen.push_back(candidate[static_cast<std::size_t>(best[k])]);
    }
    return chosen;
}

/// Chooses what to pin.
class RankDecision {
public:
    RankDecision(const SparseMap& matrix, const RigidityOptions& options)
        : matrix_(matrix), options_(options), order_(matrix.elimination_order()) {
        const double memory = 2 * order_.predicted_memory();
        if (memory > options.memory_limit) {
            throw TooLarge("the rigidity of this network would take " + std::to_string(static_cast<int>(memory / 1e9) + 1) +
                           " GB of memory, more than the limit of " + std::to_string(static_cast<int>(options.memory_limit / 1e9)) +
                           " GB");
        }
    }

    NullSpace run(const std::vector<bool>& guess, const Progress& progress) {
        progress.update("rank of the rigidity matrix", 0.0);
        const Pivots pivots = first_pivots(guess);
        for (double threshold = first_threshold; threshold <= last_threshold; threshold *= 10) {
            NullSpace space;
            space.pinned = threshold == first_threshold ? pivots.best : pivots.below(threshold, guess);
            try {
                progress.update("rank of the rigidity matrix", 0.2);
                decide(space);
                progress.update("rank of the rigidity matrix", 0.4);
                exchange(space);
                return space;
            } catch (const NotPositiveDefinite&) {  // a dependent column has a larger pivot than that
            }
        }
        throw std::runtime_error(
            "the rank of the rigidity matrix cannot be determined: its singular values approach zero without a gap");
    }

private:
    std::unique_ptr<CholeskyFactor> factorise(const std::vector<bool>& pinned) const {
        return std::make_unique<CholeskyFactor>(matrix_.gram(0, pinned), order_);
    }

    /// Too many unknowns are pinned: finds out which.
    void decide(NullSpace& space) const {
        space.factor = factorise(space.pinned);
        unpin_surplus(space);
    }

    void unpin_surplus(NullSpace& space) const {
        if (unpin_independent(space)) {
            space.factor = factorise(space.pinned);
        }
    }

    /// Pins the softest motions, null or not, and decides again, until the columns that are left are far from dependent. Pivots
    /// in the order of elimination alone choose them badly where many modes are floppy.
    void exchange(NullSpace& space) const {
        SoftMotions soft = softest(matrix_, space, options_.seed);
        for (int round = 0; round < most_exchanges && soft.smallest() < harmless; ++round) {
            const double before = soft.smallest();
            for (const Index unknown : spanning_unknowns(soft.vectors, space.pinned, false)) {
                space.pinned[static_cast<std::size_t>(unknown)] = true;
            }
            decide(space);
            soft = softest(matrix_, space, options_.seed);
            if (soft.smallest() < 2 * before) {
                break;
            }
        }
        space.smallest_nonzero = soft.smallest();
    }

    /// What a factor with a small shift tells.
    struct Pivots {
        Eigen::VectorXd value;   ///< of each unknown
        std::vector<bool> best;  ///< the guessed unknowns and as many more as have pivots below first_threshold

        std::vector<bool> below(double threshold, const std::vector<bool>& guess) const {
            std::vector<bool> pinned(guess.size());
            std::transform(value.begin(), value.end(), guess.begin(), pinned.begin(),
                           [=](double pivot, bool is_guessed) { return is_guessed || pivot < threshold; });
            return pinned;
        }
    };

    /// A column that depends on those eliminated before has a pivot of shift |x|^2, x the null vector that it makes with them.
    Pivots first_pivots(const std::vector<bool>& guess) const {
        const CholeskyFactor factor(matrix_.gram(first_shift, guess), order_);
        const std::vector<int> unknown = factor.permutation();
        Pivots pivots{Eigen::VectorXd(matrix_.unknowns()), {}};
        factor.for_each_supernode([&](const CholeskyFactor::SupernodeView& node) {
            for (int column = 0; column < node.columns; ++column) {
                const double root = node.value[static_cast<std::ptrdiff_t>(column) * (node.rows + 1)];
                const int place = node.first_column + column;
                pivots.value[unknown[static_cast<std::size_t>(place)]] = root * root;
            }
        });
        pivots.best = pivots.below(first_threshold, guess);
        const Index missing =
            std::count(pivots.best.begin(), pivots.best.end(), true) - std::count(guess.begin(), guess.end(), true);
        if (missing > 0 && missing <= most_sought) {
            pivots.best = guess;
            for (const Index column : spanning_unknowns(shifted_softest(factor, guess, missing), guess, false)) {
                pivots.best[static_cast<std::size_t>(column)] = true;
            }
        }
        return pivots;
    }

    /// Motions without stiffness, which the shift makes stand out by many orders of magnitude.
    Eigen::MatrixXd shifted_softest(const CholeskyFactor& factor, const std::vector<bool>& pinned, Index count) const {
        Eigen::MatrixXd x = rows_where(random_matrix(matrix_.unknowns(), count, Draw::motions, options_.seed), pinned, false);
        for (int k = 0; k < shifted_iterations; ++k) {
            x = dense::orthonormal(factor.solve(x));
        }
        const dense::SingularValues strains(matrix_.apply(x), dense::SingularValues::Vectors::right);
        return x * strains.vectors.rightCols((strains.values.array() < no_strain).count());
    }

    /// The part R of the pinned columns that is orthogonal to all others tells how many of them are independent after all. Its rank
    /// shows in random combinations of its columns (Halko, Martinsson and Tropp, SIAM Rev. 53 (2011) 217), squared nowhere.
    /// Returns whether some were unpinned.
    bool unpin_independent(NullSpace& space) const {
        if (std::none_of(space.pinned.begin(), space.pinned.end(), [](bool is_pinned) { return is_pinned; })) {
            return false;
        }
        for (int sketch = first_sketch;; sketch *= 2) {
            Eigen::MatrixXd x =
                rows_where(random_matrix(matrix_.unknowns(), sketch, Draw::sketch, options_.seed), space.pinned, true);
            relax(matrix_, *space.factor, space.pinned, x);
            const Eigen::MatrixXd residual = matrix_.apply(x);
            const dense::SingularValues left(residual, dense::SingularValues::Vectors::left);
            const double zero = options_.tolerance * x.colwise().norm().maxCoeff();
            const Index rank = (left.values.array() > zero).count();
            if (rank < sketch) {
                if (rank > 0) {
                    unpin(space, left.vectors.leftCols(rank));
                }
                return rank > 0;
            }
            if (sketch >= last_sketch) {
                throw NotPositiveDefinite("too many small pivots");
            }
        }
    }

    /// Unpins as many unknowns as `range` has columns: those that span it best. @param range orthonormal columns that span the
    /// range of R.
    void unpin(NullSpace& space, const Eigen::MatrixXd& range) const {
        Eigen::MatrixXd load = matrix_.apply_transposed(range);
        const Eigen::MatrixXd free = space.factor->solve(rows_where(load, space.pinned, false));
        load -= matrix_.apply_transposed(matrix_.apply(free));
        for (const Index unknown : spanning_unknowns(load, space.pinned, true)) {
            space.pinned[static_cast<std::size_t>(unknown)] = false;
        }
    }

    const SparseMap& matrix_;
    const RigidityOptions& options_;
    EliminationOrder order_;
};

}  // namespace

void relax(const SparseMap& matrix, const CholeskyFactor& factor, const std::vector<bool>& pinned, Eigen::MatrixXd& x) {
    for (int k = 0; k < refinements; ++k) {
        x -= factor.solve(rows_where(matrix.apply_transposed(matrix.apply(x)), pinned, false));
    }
}

Eigen::MatrixXd random_motions(Index unknowns, const RigidityOptions& options) {
    return random_matrix(unknowns, options.random_motions, Draw::motions, options.seed);
}

NullSpace whole_space(Index unknowns, const RigidityOptions& options) {
    NullSpace all;
    all.dimension = unknowns;
    all.pinned.assign(static_cast<std::size_t>(all.dimension), true);
    all.motions = random_motions(unknowns, options);
    return all;
}

NullSpace find_null_space(const SparseMap& matrix, const std::vector<bool>& guess, const RigidityOptions& options,
                          const Progress& progress) {
    NullSpace space = RankDecision(matrix, options).run(guess, progress);
    space.dimension = std::count(space.pinned.begin(), space.pinned.end(), true);
    space.motions = rows_where(random_motions(matrix.unknowns(), options), space.pinned, true);
    relax(matrix, *space.factor, space.pinned, space.motions);
    space.largest_zero = largest_ratio(matrix.apply(space.motions), space.motions);
    return space;
}

}  // namespace coagula::characterize
