// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitted_scales.hpp"

#include <coagula/common/parallel.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace coagula::diagnose {

namespace {

/// It fits columns again, and holds what is the same for all of them.
class FittedScales {
public:
    FittedScales(const Eigen::MatrixXd& basis, const std::vector<ScaledRows>& groups) : basis_(basis), groups_(groups) {
        for (const ScaledRows& group : groups_) {
            own_.emplace_back(basis_(group.rows, Eigen::all));
            products_.emplace_back(own_.back().transpose() * own_.back());
        }
    }

    Eigen::VectorXd over_scales(const Eigen::VectorXd& column) const {
        constexpr int most_rounds = 30;
        constexpr double converged = 0.02;  // logarithms of a variance
        Eigen::VectorXd left = column;
        std::vector<double> variances(groups_.size(), 1.0);
        Eigen::LLT<Eigen::MatrixXd> precision(Eigen::MatrixXd::Identity(basis_.cols(), basis_.cols()));
        for (int round = 0; round < most_rounds; ++round) {
            const double change = update(left, precision, variances);
            left = fitted_again(column, variances, precision);
            if (change < converged) {
                break;
            }
        }
        for (std::size_t group = 0; group < groups_.size(); ++group) {
            left(groups_[group].rows) /= std::sqrt(variances[group]);
        }
        return left;
    }

private:
    /// One step towards the most probable variances, over what the column leaves open about the fitted quantities. Returns the
    /// largest change.
    double update(const Eigen::VectorXd& left, const Eigen::LLT<Eigen::MatrixXd>& precision, std::vector<double>& variances) const {
        double change = 0;
        for (std::size_t group = 0; group < groups_.size(); ++group) {
            const std::vector<Index>& rows = groups_[group].rows;
            const double squares = left(rows).squaredNorm() + precision.solve(products_[group]).trace();
            const double degrees = groups_[group].degrees;
            const double next = (degrees + squares) / (degrees + static_cast<double>(rows.size()));
            change = std::max(change, std::abs(std::log(next / variances[group])));
            variances[group] = next;
        }
        return change;
    }

    /// Returns what is left of the column where the fitted quantities follow by these variances.
    Eigen::VectorXd fitted_again(const Eigen::VectorXd& column, const std::vector<double>& variances,
                                 Eigen::LLT<Eigen::MatrixXd>& precision) const {
        // The basis is orthonormal and orthogonal to the column: the groups change both from there.
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(basis_.cols(), basis_.cols());
        Eigen::VectorXd right = Eigen::VectorXd::Zero(basis_.cols());
        for (std::size_t group = 0; group < groups_.size(); ++group) {
            const double more = 1 / variances[group] - 1;
            matrix += more * products_[group];
            right += more * (own_[group].transpose() * column(groups_[group].rows));
        }
        precision.compute(matrix);
        return column - basis_ * precision.solve(right);
    }

    const Eigen::MatrixXd& basis_;
    const std::vector<ScaledRows>& groups_;
    std::vector<Eigen::MatrixXd> own_;       ///< of each group, rows of the basis
    std::vector<Eigen::MatrixXd> products_;  ///< of these with each other
};

}  // namespace

std::vector<ScaledRows> scaled_rows(const ErrorModel& errors) {
    const DataSet& data = errors.data();
    std::vector<ScaledRows> groups = errors.rows_of_scales();
    if (data.effect > 0 && std::isfinite(data.effect_degrees)) {
        std::vector<Index> effects(static_cast<std::size_t>(data.samples()));
        std::iota(effects.begin(), effects.end(), data.size());
        groups.push_back({data.effect_degrees, std::move(effects)});
    }
    return groups;
}

Eigen::MatrixXd over_fitted_scales(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& basis,
                                   const std::vector<ScaledRows>& groups) {
    if (groups.empty()) {
        return columns;
    }
    const FittedScales scales(basis, groups);
    Eigen::MatrixXd all(columns.rows(), columns.cols());
    constexpr Index together = 50;  // columns of one piece of work
    run_together(static_cast<std::size_t>((columns.cols() + together - 1) / together), [&](std::size_t piece) {
        const Index first = static_cast<Index>(piece) * together;
        for (Index column = first; column < std::min(first + together, columns.cols()); ++column) {
            all.col(column) = scales.over_scales(columns.col(column));
        }
    });
    return all;
}

}  // namespace coagula::diagnose
