// SPDX-License-Identifier: GPL-3.0-or-later
// The rigidity matrix of a contact network: relative displacements at the contacts as a linear map of the motion of the particles.
#pragma once

#include <coagula/characterize/rigidity.hpp>
#include <coagula/common/cholesky_factor.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace coagula::characterize {

/// A sparse matrix A whose null space is asked for.
class SparseMap {
public:
    SparseMap() = default;
    SparseMap(const SparseMap&) = default;
    SparseMap& operator=(const SparseMap&) = default;
    virtual ~SparseMap() = default;

    virtual Index unknowns() const = 0;
    /// A x for several x, as columns.
    virtual Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const = 0;
    /// A^T y.
    virtual Eigen::MatrixXd apply_transposed(const Eigen::MatrixXd& y) const = 0;
    /// Lower triangle of A^T A + shift I; a pinned unknown has a row and column of the identity instead.
    virtual Eigen::SparseMatrix<double> gram(double shift, const std::vector<bool>& pinned) const = 0;
    virtual EliminationOrder elimination_order() const = 0;
};

/// Lengths in mean radii, rotations as arc length on the mean radius: everything is a pure number. Unknowns of particle i start at
/// i * freedoms(): displacement, then rotation.
/// Normal-and-shear bonds: three rows per contact, the components along x, y, z of
///     delta = u_j - u_i - (R_i theta_i + R_j theta_j) x n.
/// Central forces: one row, (u_j - u_i) . n.
class RigidityMatrix : public SparseMap {
public:
    /// How one end of a contact moves it: rows_per_contact() x freedoms().
    using End = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 6>;

    RigidityMatrix(const Packing& packing, const ContactNetwork& contacts, Bonds bonds);

    Index particles() const { return particles_; }
    Index contacts() const { return static_cast<Index>(ends_.cols()); }
    Index freedoms() const { return freedoms_; }
    Index rows_per_contact() const { return rows_; }
    Index unknowns() const override { return freedoms_ * particles_; }
    Index constraints() const { return rows_ * contacts(); }

    Index particle(Index contact, int end) const { return ends_(end, contact); }
    const End& end(Index contact, int which) const { return (which == 0 ? first_ : second_)[static_cast<std::size_t>(contact)]; }

    Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const override;
    Eigen::MatrixXd apply_transposed(const Eigen::MatrixXd& y) const override;
    Eigen::SparseMatrix<double> gram(double shift, const std::vector<bool>& pinned) const override;
    EliminationOrder elimination_order() const override;

private:
    Index particles_;
    Index freedoms_;
    Index rows_;
    Eigen::Matrix<std::int32_t, 2, Eigen::Dynamic> ends_;
    std::vector<End> first_;
    std::vector<End> second_;
};

/// A^T of a rigidity matrix A: it maps forces at the contacts to loads on the particles, and its null space are the states of
/// self-stress. Unknowns of contact k start at k * rows_per_contact().
class LoadMatrix : public SparseMap {
public:
    /// Keeps a reference.
    explicit LoadMatrix(const RigidityMatrix& motion);

    Index unknowns() const override { return motion_.constraints(); }
    Eigen::MatrixXd apply(const Eigen::MatrixXd& x) const override { return motion_.apply_transposed(x); }
    Eigen::MatrixXd apply_transposed(const Eigen::MatrixXd& y) const override { return motion_.apply(y); }
    Eigen::SparseMatrix<double> gram(double shift, const std::vector<bool>& pinned) const override;
    EliminationOrder elimination_order() const override;

private:
    struct Touch {
        Index contact;
        int end;
    };

    const RigidityMatrix& motion_;
    std::vector<std::vector<Touch>> touches_;  ///< of each particle, by contact
};

/// The motions of the sample as a whole: translations, and rotations where the cell is open. Columns, not necessarily independent.
Eigen::MatrixXd rigid_motions(const Packing& packing, const RigidityMatrix& matrix);

}  // namespace coagula::characterize
