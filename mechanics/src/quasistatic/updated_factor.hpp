// SPDX-License-Identifier: GPL-3.0-or-later
// Factor of the tangent of a sheared network that follows the contacts which open, close, slip or break.
#pragma once

#include "sheared_network.hpp"
#include "stiffness_of_contacts.hpp"

#include <coagula/common/cholesky_factor.hpp>
#include <coagula/common/dense.hpp>

#include <memory>
#include <vector>

namespace coagula::mechanics {

/// Cholesky factor A of the symmetric part of a tangent, and the contacts without a bond that have changed since, by the formula of
/// Sherman, Morrison and Woodbury: (A + B D B^T)^-1 = A^-1 - A^-1 B (1 + D B^T A^-1 B)^-1 D B^T A^-1. Contacts may slip, so that D
/// need not be symmetric. Columns of A^-1 B are kept.
class UpdatedFactor {
public:
    /// Factorises the tangent at a trial motion. Where its symmetric part has directions of negative stiffness, the contacts'
    /// parts without theirs are summed instead. @param damping added to the stiffness of every particle, in contact stiffnesses.
    UpdatedFactor(const ShearedNetwork& network, const Trial& trial, double damping = 0);

    /// Takes in the contacts without a bond as they are now. Returns whether any has changed.
    bool update(const ShearedNetwork& network, const Trial& trial);

    Motion solve(const Motion& load) const;

    /// Number of columns of B.
    Index rank() const { return rank_; }
    /// Whether no more contacts can be taken in.
    bool is_full() const { return full_; }
    /// Generation of the neighbours for which the contacts of the factor are numbered (ShearedNetwork::generation).
    Index generation() const { return generation_; }
    bool is_convex() const { return convex_; }
    Index factorisations() const { return factorisations_; }

private:
    struct Change {
        Index contact;
        Index column;  ///< the first of B
        ContactModes modes;
        Slope now;
    };

    void factorise(const ShearedNetwork& network, const Trial& trial, double least_shift);
    Change* find_change(Index contact);
    void add(const ShearedNetwork& network, const Trial& trial, const std::vector<Index>& contacts);
    Eigen::VectorXd project(const Motion& motion) const;

    std::unique_ptr<CholeskyFactor> factor_;
    std::vector<Slope> factored_;         ///< of every contact, what is in the factor
    std::vector<bool> factored_moments_;  ///< whether that of a contact has moments
    std::vector<Change> changes_;
    std::vector<std::pair<Index, Index>> ends_;       ///< of every column of B
    Eigen::Matrix<double, 12, Eigen::Dynamic> base_;  ///< B at the two ends
    Eigen::MatrixXd compliance_;                      ///< A^-1 B
    Eigen::MatrixXd inner_;                           ///< B^T A^-1 B
    Eigen::MatrixXd change_;                          ///< D
    dense::LuFactors solver_;                         ///< of 1 + D B^T A^-1 B
    Index rank_ = 0;
    Index generation_ = 0;
    Index factorisations_ = 0;
    bool full_ = false;
    bool convex_ = true;
};

}  // namespace coagula::mechanics
