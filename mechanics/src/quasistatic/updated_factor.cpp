// SPDX-License-Identifier: GPL-3.0-or-later
#include "updated_factor.hpp"

#include "solvers/block_factor.hpp"

#include <coagula/common/blas_threads.hpp>

#include <algorithm>

namespace coagula::mechanics {

namespace {

constexpr int factor_threads = 1;        // the bits of a factor depend on it; a solution with one load gains nothing from more
constexpr double smallest_shift = 1e-8;  // in contact stiffnesses
constexpr double stiffest_shift = 10;
constexpr double noticed = 1e-3;  // change of a contact's tangent, in contact stiffnesses
constexpr Index most_columns = 200;

}  // namespace

UpdatedFactor::UpdatedFactor(const ShearedNetwork& network, const Trial& trial, double damping)
    : generation_(network.generation()) {
    factorise(network, trial, std::max(damping, smallest_shift));
    base_.resize(12, most_columns);
    compliance_.resize(6 * network.particles(), most_columns);
    inner_.resize(most_columns, most_columns);
    change_ = Eigen::MatrixXd::Zero(most_columns, most_columns);
    update(network, trial);
}

void UpdatedFactor::factorise(const ShearedNetwork& network, const Trial& trial, double least_shift) {
    const StiffnessOfContacts stiffness(network, trial);
    const BlasThreads threads(factor_threads);
    auto convex = StiffnessOfContacts::Convex::contacts_without_bond;
    BlockMatrix matrix = stiffness.symmetric_part(convex);
    const EliminationOrder order = elimination_order(matrix, Ordering::nested_dissection);
    for (double shift = least_shift;; shift *= 10) {
        ++factorisations_;
        try {
            factor_ = std::make_unique<CholeskyFactor>(shifted(matrix, shift), order);
            break;
        } catch (const NotPositiveDefinite&) {
            if (shift > stiffest_shift) {
                throw;
            }
            if (convex_) {
                convex_ = false;
                convex = StiffnessOfContacts::Convex::all;
                matrix = stiffness.symmetric_part(convex);
                shift = 0.1 * least_shift;
            }
        }
    }
    factored_moments_.assign(network.contacts().size(), false);
    for (std::size_t k = 0; k < factored_moments_.size(); ++k) {
        factored_moments_[k] = trial.memory[k].bonded && network.has_moments();
    }
    factored_.assign(network.contacts().size(), Slope::Zero());
    stiffness.for_each_part(convex, [&](Index contact, const Slope& part) { factored_[static_cast<std::size_t>(contact)] = part; });
}

UpdatedFactor::Change* UpdatedFactor::find_change(Index contact) {
    const auto found =
        std::find_if(changes_.begin(), changes_.end(), [&](const Change& change) { return change.contact == contact; });
    return found == changes_.end() ? nullptr : &*found;
}

/// Columns for contacts that had none.
void UpdatedFactor::add(const ShearedNetwork& network, const Trial& trial, const std::vector<Index>& contacts) {
    const Index before = rank_;
    for (const Index contact : contacts) {
        const ShearedContact& pair = network.contacts()[static_cast<std::size_t>(contact)];
        const bool turns = factored_moments_[static_cast<std::size_t>(contact)];
        const ContactModes modes = network.modes_of(contact, trial, turns);
        const Index columns = modes.cols();
        if (rank_ + columns > most_columns) {
            full_ = true;
            break;
        }
        changes_.push_back({contact, rank_, modes, factored_[static_cast<std::size_t>(contact)]});
        for (Index k = 0; k < columns; ++k, ++rank_) {
            ends_.emplace_back(pair.first, pair.second);
            base_.col(rank_) << -modes.col(k).head<3>(), modes.col(k).segment<3>(3), modes.col(k).head<3>(), modes.col(k).tail<3>();
        }
    }
    if (rank_ == before) {
        return;
    }
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(compliance_.rows(), rank_ - before);
    for (Index column = before; column < rank_; ++column) {
        const auto [first, second] = ends_[static_cast<std::size_t>(column)];
        loads.col(column - before).segment<6>(6 * first) = base_.col(column).head<6>();
        loads.col(column - before).segment<6>(6 * second) = base_.col(column).tail<6>();
    }
    const BlasThreads threads(factor_threads);
    loads = factor_->solve(loads);
    compliance_.middleCols(before, rank_ - before) = loads;
    for (Index column = before; column < rank_; ++column) {
        inner_.col(column).head(rank_) = project(compliance_.col(column));
        inner_.row(column).head(rank_) = inner_.col(column).head(rank_).transpose();
    }
}

bool UpdatedFactor::update(const ShearedNetwork& network, const Trial& trial) {
    std::vector<std::pair<Index, Slope>> changed;
    std::vector<Index> unknown;
    const auto count = static_cast<Index>(network.contacts().size());
    for (Index contact = 0; contact < count; ++contact) {
        const auto k = static_cast<std::size_t>(contact);
        const ShearedContact& pair = network.contacts()[k];
        if (trial.memory[k].bonded || pair.first == pair.second) {
            continue;
        }
        const Change* known = find_change(contact);
        const Slope now = network.slope_of(contact, trial);
        if ((now - (known != nullptr ? known->now : factored_[k])).norm() > noticed) {
            changed.emplace_back(contact, now);
            if (known == nullptr) {
                unknown.push_back(contact);
            }
        }
    }
    if (changed.empty()) {
        return false;
    }
    add(network, trial, unknown);
    for (const auto& [contact, now] : changed) {
        if (Change* change = find_change(contact)) {
            const Eigen::MatrixXd inverse = dense::pseudo_inverse(change->modes).transpose();
            const Index columns = inverse.cols();
            change->now = now;
            change_.block(change->column, change->column, columns, columns) =
                inverse.transpose() * Eigen::MatrixXd(now - factored_[static_cast<std::size_t>(contact)]) * inverse;
        }
    }
    solver_ = dense::LuFactors(Eigen::MatrixXd::Identity(rank_, rank_) +
                               change_.topLeftCorner(rank_, rank_) * inner_.topLeftCorner(rank_, rank_));
    return true;
}

Eigen::VectorXd UpdatedFactor::project(const Motion& motion) const {
    Eigen::VectorXd all(rank_);
    for (Index k = 0; k < rank_; ++k) {
        const auto [first, second] = ends_[static_cast<std::size_t>(k)];
        all[k] =
            base_.col(k).head<6>().dot(motion.segment<6>(6 * first)) + base_.col(k).tail<6>().dot(motion.segment<6>(6 * second));
    }
    return all;
}

Motion UpdatedFactor::solve(const Motion& load) const {
    const BlasThreads threads(factor_threads);
    Motion motion = factor_->solve(load);
    if (rank_ > 0) {
        const Eigen::VectorXd weight = solver_.solve(change_.topLeftCorner(rank_, rank_) * project(motion));
        motion.noalias() -= compliance_.leftCols(rank_) * weight;
    }
    return motion;
}

}  // namespace coagula::mechanics
