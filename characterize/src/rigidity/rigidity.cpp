// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/rigidity.hpp>

#include "local_motions.hpp"
#include "null_space.hpp"
#include "rigid_clusters.hpp"
#include "rigidity_matrix.hpp"
#include "selected_inverse.hpp"
#include "self_stress.hpp"

#include <coagula/characterize/coordination.hpp>
#include <coagula/common/blas_threads.hpp>
#include <coagula/common/dense.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace coagula::characterize {

namespace {

constexpr int blas_threads = 2;  // fixed: the bits of a factor depend on it

void check(const Packing& packing, const ContactNetwork& contacts, const RigidityOptions& options) {
    coagula::check(packing);
    require(contacts.particles == packing.size(), "the contacts belong to a packing of " + std::to_string(contacts.particles) +
                                                      " particles, the packing has " + std::to_string(packing.size()));
    require_positive(options.tolerance, "the tolerance of floppy modes");
    require_positive(options.rigid_tolerance, "the tolerance of rigid clusters");
    require(options.random_motions >= 1, "at least one random motion must tell rigid clusters apart");
}

/// A_a Z_ab A_b^T over both ends: how much of each row of a contact lies in the range of A.
Eigen::MatrixXd leverage(const RigidityMatrix& matrix, const SelectedInverse& inverse, const std::vector<bool>& pinned,
                         Index contact) {
    const Index freedoms = matrix.freedoms();
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(matrix.rows_per_contact(), matrix.rows_per_contact());
    for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) {
            Eigen::MatrixXd block = Eigen::MatrixXd::Zero(freedoms, freedoms);
            for (Index r = 0; r < freedoms; ++r) {
                for (Index c = 0; c < freedoms; ++c) {
                    const Index row = freedoms * matrix.particle(contact, a) + r;
                    const Index column = freedoms * matrix.particle(contact, b) + c;
                    if (!pinned[static_cast<std::size_t>(row)] && !pinned[static_cast<std::size_t>(column)]) {
                        block(r, c) = inverse(static_cast<int>(row), static_cast<int>(column));
                    }
                }
            }
            sum += matrix.end(contact, a) * block * matrix.end(contact, b).transpose();
        }
    }
    return sum;
}

/// Shares the redundancy of each contact among its two particles.
void share_redundancies(const ContactNetwork& contacts, Index freedoms, Index rows, Rigidity& result) {
    result.particle_redundancy = Eigen::VectorXd::Zero(contacts.particles);
    result.particle_freedom = Eigen::VectorXd::Constant(contacts.particles, static_cast<double>(freedoms));
    result.trace_defect = std::abs(result.contact_redundancy.sum() - static_cast<double>(result.self_stresses));
    result.contact_redundancy = result.contact_redundancy.cwiseMax(0.0);  // rounding errors
    result.normal_redundancy = result.normal_redundancy.cwiseMax(0.0);
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const double half = 0.5 * result.contact_redundancy[contact];
        for (int end = 0; end < 2; ++end) {
            result.particle_redundancy[contacts.ends(end, contact)] += half;
            result.particle_freedom[contacts.ends(end, contact)] += half - 0.5 * static_cast<double>(rows);
        }
    }
}

void find_redundancies(const RigidityMatrix& matrix, const NullSpace& space, const ContactNetwork& contacts, Rigidity& result) {
    result.contact_redundancy = Eigen::VectorXd::Zero(contacts.size());
    result.normal_redundancy = Eigen::VectorXd::Zero(contacts.size());
    if (contacts.size() == 0) {
        return;
    }
    const SelectedInverse inverse(*space.factor);
#pragma omp parallel for schedule(static)
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const Index rows = matrix.rows_per_contact();
        const Eigen::MatrixXd redundancy = Eigen::MatrixXd::Identity(rows, rows) - leverage(matrix, inverse, space.pinned, contact);
        result.contact_redundancy[contact] = redundancy.trace();
        const Eigen::Vector3d normal = contacts.branch.col(contact).normalized();
        result.normal_redundancy[contact] = rows == 1 ? redundancy(0, 0) : normal.dot(redundancy * normal);
    }
}

void count_modes(const Packing& packing, const ContactNetwork& contacts, const RigidityMatrix& matrix, Rigidity& result) {
    result.unknowns = matrix.unknowns();
    result.constraints = matrix.constraints();
    result.self_stresses = result.constraints - result.rank;
    result.rigid_motions = dense::PivotedQr(rigid_motions(packing, matrix)).rank;
    result.floppy_modes = result.unknowns - result.rank - result.rigid_motions;
    const Eigen::VectorXi left = prune_rattlers(contacts);
    result.rattlers = (left.array() < 0).count();
    Index removed = 0;
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        removed += left[contacts.ends(0, contact)] < 0 || left[contacts.ends(1, contact)] < 0 ? 1 : 0;
    }
    result.rattler_modes = matrix.freedoms() * result.rattlers - matrix.rows_per_contact() * removed;
}

void share_self_stress(const ContactNetwork& contacts, Rigidity& result) {
    RigidClusters& rigid = result.rigid;
    rigid.self_stress = Eigen::VectorXd::Zero(static_cast<Index>(rigid.clusters.size()));
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const int cluster = rigid.of_particle[contacts.ends(0, contact)];
        if (cluster >= 0 && cluster == rigid.of_particle[contacts.ends(1, contact)]) {
            rigid.self_stress[cluster] += result.contact_redundancy[contact];
        }
    }
}

/// Rank, checks and redundancies by way of the states of self-stress; whether there are few enough.
bool measure_by_self_stress(const RigidityMatrix& matrix, const RigidityOptions& options, const Progress& progress,
                            Rigidity& result) {
    const std::optional<SelfStress> found = find_self_stress(matrix, options, progress);
    if (!found) {
        return false;
    }
    result.rank = matrix.constraints() - found->dimension;
    result.largest_zero = found->largest_zero;
    result.smallest_nonzero = found->smallest_nonzero;
    result.contact_redundancy = result.normal_redundancy = found->redundancy;
    return true;
}

/// Rank, checks and redundancies by way of the floppy motions, which also tell rigid clusters apart.
void measure_by_motions(const Packing& packing, const ContactNetwork& contacts, const RigidityMatrix& matrix,
                        const RigidityOptions& options, const Progress& progress, Rigidity& result) {
    const NullSpace space = matrix.contacts() > 0
                                ? find_null_space(matrix, guess_pinned(matrix, packing.cell.is_open()), options, progress)
                                : whole_space(matrix.unknowns(), options);
    result.rank = matrix.unknowns() - space.dimension;
    result.largest_zero = space.largest_zero;
    result.smallest_nonzero = space.smallest_nonzero;
    progress.update("local redundancy", 0.6);
    find_redundancies(matrix, space, contacts, result);
    if (options.bonds == Bonds::normal_and_shear) {
        result.rigid = find_rigid_clusters(packing, contacts, space.motions, options.rigid_tolerance);
    }
}

}  // namespace

Rigidity measure_rigidity(const Packing& packing, const ContactNetwork& contacts, const RigidityOptions& options,
                          const Progress& progress) {
    check(packing, contacts, options);
    const BlasThreads threads(blas_threads);
    const RigidityMatrix matrix(packing, contacts, options.bonds);
    Rigidity result;
    const bool is_loose = options.bonds == Bonds::central && matrix.contacts() > 0 && matrix.constraints() < matrix.unknowns();
    if (!is_loose || !measure_by_self_stress(matrix, options, progress, result)) {
        measure_by_motions(packing, contacts, matrix, options, progress, result);
    }
    count_modes(packing, contacts, matrix, result);
    share_redundancies(contacts, matrix.freedoms(), matrix.rows_per_contact(), result);
    if (options.bonds == Bonds::normal_and_shear) {
        share_self_stress(contacts, result);
    }
    return result;
}

}  // namespace coagula::characterize
