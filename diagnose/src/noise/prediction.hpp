// SPDX-License-Identifier: GPL-3.0-or-later
// Prediction of a model for every measured number.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <utility>

namespace coagula::diagnose {

/// Independent errors of a prediction, over their standard errors.
struct ModelErrors {
    Eigen::MatrixXd changes = {};                              ///< numbers x errors: slopes of the numbers by these
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which their common scale is known
    Eigen::VectorXd linearised_at = {};  ///< errors at which numbers and slopes are those of the model; empty: 0
};

struct Prediction {
    Eigen::VectorXd values;  ///< at the errors `errors.linearised_at`
    /// Change by the logarithm of the level of the material, which differs from sample to sample; the tool's own share stays.
    Eigen::VectorXd level_slope;
    ModelErrors errors = {};

    /// Prediction for the material alone, which scales with its level.
    Prediction(Eigen::VectorXd all) : values(std::move(all)), level_slope(values) {}  // NOLINT(google-explicit-constructor)
    Prediction(Eigen::VectorXd all, Eigen::VectorXd slope, ModelErrors model_errors)
        : values(std::move(all)), level_slope(std::move(slope)), errors(std::move(model_errors)) {
        if (errors.linearised_at.size() == 0) {
            errors.linearised_at.setZero(errors.changes.cols());
        }
    }

    /// Prediction with these errors, along straight lines.
    Eigen::VectorXd with(const Eigen::VectorXd& some) const {
        return errors.linearised_at.size() == 0 ? values : Eigen::VectorXd(values + errors.changes * (some - errors.linearised_at));
    }
    /// Where straight lines through `values` lead without any error.
    Eigen::VectorXd without_errors() const { return with(Eigen::VectorXd::Zero(errors.linearised_at.size())); }
};

}  // namespace coagula::diagnose
