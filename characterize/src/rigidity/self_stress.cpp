// SPDX-License-Identifier: GPL-3.0-or-later
#include "self_stress.hpp"

#include "null_space.hpp"

#include <coagula/common/dense.hpp>

#include <algorithm>

namespace coagula::characterize {

namespace {

constexpr Index most_states = 256;  // their orthonormal basis is a dense matrix

/// The state for each pinned contact force: one there and none at the others that are pinned. Columns, orthonormal.
Eigen::MatrixXd orthonormal_states(const LoadMatrix& loads, const NullSpace& space) {
    Eigen::MatrixXd states = Eigen::MatrixXd::Zero(loads.unknowns(), space.dimension);
    Index state = 0;
    for (Index row = 0; row < loads.unknowns(); ++row) {
        if (space.pinned[static_cast<std::size_t>(row)]) {
            states(row, state++) = 1;
        }
    }
    relax(loads, *space.factor, space.pinned, states);
    return dense::orthonormal(states);
}

/// Takes from random motions what strains a contact; two passes, because of rounding.
double largest_zero(const RigidityMatrix& matrix, const NullSpace& space, const RigidityOptions& options) {
    Eigen::MatrixXd x = random_motions(matrix.unknowns(), options);
    for (int pass = 0; pass < 2; ++pass) {
        Eigen::MatrixXd strain = matrix.apply(x);
        for (Index row = 0; row < strain.rows(); ++row) {
            if (space.pinned[static_cast<std::size_t>(row)]) {
                strain.row(row).setZero();
            }
        }
        x -= matrix.apply_transposed(space.factor->solve(std::move(strain)));
    }
    return (matrix.apply(x).colwise().norm().array() / x.colwise().norm().array()).maxCoeff();
}

}  // namespace

std::optional<SelfStress> find_self_stress(const RigidityMatrix& matrix, const RigidityOptions& options, const Progress& progress) {
    const LoadMatrix loads(matrix);
    RigidityOptions for_states = options;
    for_states.random_motions = 1;
    NullSpace space;
    try {
        space = find_null_space(loads, std::vector<bool>(static_cast<std::size_t>(loads.unknowns()), false), for_states, progress);
    } catch (const std::runtime_error&) {  // too many states, or stiffness that fades
        return {};
    }
    if (space.dimension > most_states) {
        return {};
    }
    SelfStress found;
    found.dimension = space.dimension;
    found.smallest_nonzero = space.smallest_nonzero;
    found.largest_zero = largest_zero(matrix, space, options);
    found.redundancy = Eigen::VectorXd::Zero(matrix.constraints());
    if (space.dimension > 0) {
        found.redundancy = orthonormal_states(loads, space).rowwise().squaredNorm();
    }
    return found;
}

}  // namespace coagula::characterize
