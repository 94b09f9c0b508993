// What a model says of every number that was measured.
#pragma once

#include "model_errors.hpp"

#include <Eigen/Core>

#include <utility>

namespace coagula::diagnose {

struct Prediction {
    Eigen::VectorXd values;
    /// Change by the logarithm of the level of the material, which differs from sample to sample; the tool's own share stays.
    Eigen::VectorXd level_slope;
    ModelErrors errors = {};

    /// Of the material alone, which all scales with its level.
    Prediction(Eigen::VectorXd all) : values(std::move(all)), level_slope(values) {}  // NOLINT(google-explicit-constructor)
    Prediction(Eigen::VectorXd all, Eigen::VectorXd slope, ModelErrors model_errors)
        : values(std::move(all)), level_slope(std::move(slope)), errors(std::move(model_errors)) {}
};

}  // namespace coagula::diagnose
