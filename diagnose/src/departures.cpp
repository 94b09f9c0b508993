#include "departures.hpp"

#include <cmath>

namespace coagula::diagnose {

Departures departures_of(const Inference& inference, const Fit& fit) {
    const DataSet& data = inference.likelihood().data();
    const Eigen::VectorXd prediction = inference.forward().predict(fit.settings);
    const double stiffness = inference.stiffness_departure(std::log(fit.settings.normal_stiffness));
    const Index samples = data.effect > 0 ? data.samples() : 0;
    const Index rows = data.size() + samples + (std::isfinite(stiffness) ? 1 : 0);
    const Eigen::MatrixXd slopes = inference.jacobian(fit);
    const Index first_effect = slopes.cols() - data.samples();

    Departures all{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, slopes.cols())};
    all.residual.head(data.size()) = inference.likelihood().residual(prediction);
    all.jacobian.topRows(data.size()) = slopes;
    if (samples > 0) {
        all.residual.segment(data.size(), samples) = -inference.likelihood().effects(prediction) / data.effect;
        all.jacobian.block(data.size(), first_effect, samples, samples).diagonal().setConstant(1 / data.effect);
    }
    if (std::isfinite(stiffness)) {
        all.residual[rows - 1] = -stiffness;
        all.jacobian(rows - 1, 0) = 1 / inference.forward().experiment().sample.normal_stiffness_error;
    }
    return all;
}

}  // namespace coagula::diagnose
