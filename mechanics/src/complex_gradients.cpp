#include "complex_gradients.hpp"

#include <algorithm>

namespace coagula::mechanics {

namespace {

using Index = Eigen::Index;
using Row = Eigen::Array<double, 1, 6>;
using ComplexRow = Eigen::Array<Complex, 1, 6>;
using Columns = Eigen::Array<bool, 1, 6>;

constexpr Index piece = 4096;

/// Column-wise sums of `term` (rows of the pieces); in fixed pieces, so that the bits do not depend on the number of threads.
template <class Value, class Term>
Eigen::Array<Value, 1, 6> sum_of(Index rows, const Term& term) {
    const Index pieces = (rows + piece - 1) / piece;
    Eigen::Array<Value, Eigen::Dynamic, 6, Eigen::RowMajor> part(pieces, 6);
#pragma omp parallel for schedule(static)
    for (Index k = 0; k < pieces; ++k) {
        part.row(k) = term(k * piece, std::min(piece, rows - k * piece));
    }
    return part.colwise().sum();
}

/// a.b without conjugation.
ComplexRow product(const ComplexLoads& a, const ComplexLoads& b) {
    return sum_of<Complex>(a.rows(), [&](Index first, Index rows) -> ComplexRow {
        return (a.middleRows(first, rows).array() * b.middleRows(first, rows).array()).colwise().sum();
    });
}

Row norm(const ComplexLoads& a) {
    return sum_of<double>(a.rows(),
                          [&](Index first, Index rows) -> Row { return a.middleRows(first, rows).array().abs2().colwise().sum(); })
        .sqrt();
}

/// a += b * factor, column by column.
void add_scaled(ComplexLoads& a, const ComplexLoads& b, const ComplexRow& factor) {
#pragma omp parallel for schedule(static)
    for (Index row = 0; row < a.rows(); ++row) {
        a.row(row).array() += b.row(row).array() * factor;
    }
}

/// a = b + a * factor.
void scale_and_add(ComplexLoads& a, const ComplexRow& factor, const ComplexLoads& b) {
#pragma omp parallel for schedule(static)
    for (Index row = 0; row < a.rows(); ++row) {
        a.row(row).array() = b.row(row).array() + a.row(row).array() * factor;
    }
}

/// Quotient where the column is still being solved, zero where it has ended or the method breaks down.
ComplexRow quotient(const ComplexRow& numerator, const ComplexRow& denominator, const Columns& open) {
    ComplexRow result = ComplexRow::Zero();
    for (Index column = 0; column < 6; ++column) {
        if (open[column] && std::abs(denominator[column]) > 0) {
            result[column] = numerator[column] / denominator[column];
        }
    }
    return result;
}

Row relative(const Row& value, const Row& reference, const Columns& loaded) {
    return loaded.select(value / reference, 0.0);
}

}  // namespace

ComplexSolution conjugate_orthogonal_gradients(const std::function<void(const ComplexLoads&, ComplexLoads&)>& multiply,
                                               const ComplexLoads& f, const Row& least_load,
                                               const std::function<void(const ComplexLoads&, ComplexLoads&)>& precondition,
                                               double tolerance, int most_iterations) {
    const Row size = norm(f);
    const Columns loaded = size > least_load;
    ComplexSolution solution;
    ComplexLoads& x = solution.motion;
    x = ComplexLoads::Zero(f.rows(), 6);
    ComplexLoads r = f;
    ComplexLoads z;
    precondition(r, z);
    ComplexLoads d = z;
    ComplexLoads q;
    ComplexRow rz = product(r, z);
    Columns open = loaded;
    while (open.any() && solution.iterations < most_iterations) {
        multiply(d, q);
        const ComplexRow alpha = quotient(rz, product(d, q), open);
        add_scaled(x, d, alpha);
        add_scaled(r, q, -alpha);
        ++solution.iterations;
        open = open && relative(norm(r), size, loaded) > tolerance && alpha.abs() > 0;
        if (open.any()) {
            precondition(r, z);
            const ComplexRow next = product(r, z);
            scale_and_add(d, quotient(next, rz, open), z);
            rz = next;
        }
    }
    multiply(x, q);
    q = f - q;
    solution.residual = relative(norm(q), size, loaded).maxCoeff();
    return solution;
}

}  // namespace coagula::mechanics
