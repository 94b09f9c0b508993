// SPDX-License-Identifier: GPL-3.0-or-later
#include "complex_gradients.hpp"

#include "column_sums.hpp"

namespace coagula::mechanics {

namespace {

using Index = Eigen::Index;
using Row = SixValues<double>;
using ComplexRow = SixValues<Complex>;
using Columns = Eigen::Array<bool, 1, 6>;

Row norm(const ComplexLoads& a) {
    return sum_of_pieces<double>(
               a.rows(), [&](Index first, Index rows) -> Row { return a.middleRows(first, rows).array().abs2().colwise().sum(); })
        .sqrt();
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
                                               const ComplexLoads& f, const Row& load_scale,
                                               const std::function<void(const ComplexLoads&, ComplexLoads&)>& precondition,
                                               double tolerance, int most_iterations) {
    const Columns loaded = norm(f) > rounding_of_loads * load_scale;
    const Row size = norm(f).max(least_load * load_scale);
    ComplexSolution solution;
    ComplexLoads& x = solution.motion;
    x = ComplexLoads::Zero(f.rows(), 6);
    ComplexLoads r = f;
    ComplexLoads z;
    precondition(r, z);
    ComplexLoads d = z;
    ComplexLoads q;
    ComplexRow rz = dot(r, z);
    Columns open = loaded;
    while (open.any() && solution.iterations < most_iterations) {
        multiply(d, q);
        const ComplexRow alpha = quotient(rz, dot(d, q), open);
        add_scaled(x, d, alpha);
        add_scaled(r, q, -alpha);
        ++solution.iterations;
        open = open && relative(norm(r), size, loaded) > tolerance && alpha.abs() > 0;
        if (open.any()) {
            precondition(r, z);
            const ComplexRow next = dot(r, z);
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
