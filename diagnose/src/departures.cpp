#include "departures.hpp"

#include <cmath>

namespace coagula::diagnose {

Departures departures_of(const Inference& inference, const Fit& fit) {
    const DataSet& data = inference.likelihood().data();
    const Eigen::VectorXd prediction = inference.forward().predict(fit.settings);
    const double stiffness = inference.stiffness_departure(std::log(fit.settings.normal_stiffness));
    const Eigen::MatrixXd errors = inference.forward().yield_errors(fit.settings);
    const Index samples = data.effect > 0 ? data.samples() : 0;
    const Index effects = samples + errors.cols();
    const Index rows = data.size() + effects + (std::isfinite(stiffness) ? 1 : 0);
    const Eigen::MatrixXd slopes = inference.jacobian(fit);
    const Index first_error = slopes.cols() - errors.cols();
    const Index first_effect = first_error - data.samples();
    const Eigen::VectorXd fitted = inference.likelihood().effects(prediction, errors);

    Departures all{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, slopes.cols())};
    all.residual.head(data.size()) = inference.likelihood().residual(prediction, errors);
    all.jacobian.topRows(data.size()) = slopes;
    if (samples > 0) {
        all.residual.segment(data.size(), samples) = -fitted.head(samples) / data.effect;
        all.jacobian.block(data.size(), first_effect, samples, samples).diagonal().setConstant(1 / data.effect);
    }
    all.residual.segment(data.size() + samples, errors.cols()) = -fitted.tail(errors.cols());
    all.jacobian.block(data.size() + samples, first_error, errors.cols(), errors.cols()).diagonal().setOnes();
    if (std::isfinite(stiffness)) {
        all.residual[rows - 1] = -stiffness;
        all.jacobian(rows - 1, 0) = 1 / inference.stiffness_error();
    }
    return all;
}

}  // namespace coagula::diagnose
