// SPDX-License-Identifier: GPL-3.0-or-later
#include "departures.hpp"

#include <coagula/common/dense.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace coagula::diagnose {

namespace {

/// What the fitted quantities move: without parameters at an end of their prior, which cannot follow, and without the samples'
/// effects where it is stated, and not estimated, that there are none.
Eigen::MatrixXd slopes_of(const Inference& inference, const Fit& fit, Index errors) {
    const DataSet& data = inference.errors().data();
    const Eigen::MatrixXd all = inference.jacobian(fit);
    const bool effects = data.effect > 0 || std::isfinite(data.effect_degrees);
    const Index others = errors + data.samples();
    std::vector<Index> kept;
    for (Index column = 0; column < all.cols(); ++column) {
        const bool parameter = column > 0 && column < all.cols() - others;
        const auto number = static_cast<std::size_t>(column - 1);
        const bool stays = parameter && number < fit.active_end.size() && fit.active_end[number];
        const bool effect = column >= all.cols() - others && column < all.cols() - errors;
        if (!stays && (effects || !effect)) {
            kept.push_back(column);
        }
    }
    return all(Eigen::all, kept);
}

}  // namespace

Departures departures_of(const Inference& inference, const Fit& fit) {
    const DataSet& data = inference.errors().data();
    const Prediction prediction = inference.prediction(fit.model);
    const double stiffness = inference.stiffness_departure(std::log(fit.model.settings.normal_stiffness));
    const Index errors = prediction.errors.changes.cols();
    const Index samples = data.effect > 0 ? data.samples() : 0;
    const Index effects = samples + errors;
    const Index rows = data.size() + effects + (std::isfinite(stiffness) ? 1 : 0);
    const Eigen::MatrixXd slopes = slopes_of(inference, fit, errors);
    const Index first_error = slopes.cols() - errors;
    const Index first_effect = first_error - samples;
    const Eigen::VectorXd fitted = inference.errors().effects(prediction);

    Departures all{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, slopes.cols())};
    all.residual.head(data.size()) = inference.errors().residual(prediction);
    all.jacobian.topRows(data.size()) = slopes;
    if (samples > 0) {
        all.residual.segment(data.size(), samples) = -fitted.head(samples) / data.effect;
        all.jacobian.block(data.size(), first_effect, samples, samples).diagonal().setConstant(1 / data.effect);
    }
    all.residual.segment(data.size() + samples, errors) = -fitted.tail(errors);
    all.jacobian.block(data.size() + samples, first_error, errors, errors).diagonal().setOnes();
    if (std::isfinite(stiffness)) {
        all.residual[rows - 1] = -stiffness;
        all.jacobian(rows - 1, 0) = 1 / inference.stiffness_error();
    }
    return all;
}

RowCorrelations correlations_by_base(const Forward& forward, const DataSet& data) {
    const bool uncertain = std::any_of(data.observations.begin(), data.observations.end(),
                                       [](const Observation& one) { return one.errors.correlation_error > 0; });
    if (!uncertain) {
        return {};
    }
    const ErrorModel errors(data);
    const Inference inference(forward, errors);
    const Prediction base = inference.prediction(inference.fit({}).model);
    const Eigen::VectorXd effects = errors.effects(base);
    Eigen::VectorXd left = data.values - base.with(effects.tail(base.errors.linearised_at.size()));
    for (Index row = 0; row < data.size(); ++row) {
        const Index sample = data.sample[static_cast<std::size_t>(row)];
        left[row] -= sample >= 0 ? base.level_slope[row] * effects[sample] : 0.0;
    }
    return correlations_shown(data, left);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
    return dense::PivotedQr(columns).basis;
}

}  // namespace coagula::diagnose
