#include "departures.hpp"

#include <Eigen/QR>

#include <cmath>

namespace coagula::diagnose {

namespace {

/// What the fitted quantities move: without the samples' effects where it is stated, and not estimated, that there are none.
Eigen::MatrixXd slopes_of(const Inference& inference, const Fit& fit, Index errors) {
    const DataSet& data = inference.likelihood().data();
    const Eigen::MatrixXd all = inference.jacobian(fit);
    if (data.effect > 0 || std::isfinite(data.effect_degrees)) {
        return all;
    }
    Eigen::MatrixXd slopes(all.rows(), all.cols() - data.samples());
    slopes << all.leftCols(slopes.cols() - errors), all.rightCols(errors);
    return slopes;
}

}  // namespace

Departures departures_of(const Inference& inference, const Fit& fit) {
    const DataSet& data = inference.likelihood().data();
    const Eigen::VectorXd prediction = inference.forward().predict(fit.settings);
    const double stiffness = inference.stiffness_departure(std::log(fit.settings.normal_stiffness));
    const ModelErrors model = inference.forward().yield_errors(fit.settings);
    const Index errors = model.changes.cols();
    const Index samples = data.effect > 0 ? data.samples() : 0;
    const Index effects = samples + errors;
    const Index rows = data.size() + effects + (std::isfinite(stiffness) ? 1 : 0);
    const Eigen::MatrixXd slopes = slopes_of(inference, fit, errors);
    const Index first_error = slopes.cols() - errors;
    const Index first_effect = first_error - samples;
    const Eigen::VectorXd fitted = inference.likelihood().effects(prediction, model);

    Departures all{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, slopes.cols())};
    all.residual.head(data.size()) = inference.likelihood().residual(prediction, model);
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

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(columns);
    return factor.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), factor.rank());
}

}  // namespace coagula::diagnose
