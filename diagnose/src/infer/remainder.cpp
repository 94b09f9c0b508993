#include "remainder.hpp"

#include "noise/low_rank.hpp"
#include "noise/weights.hpp"

#include <cmath>
#include <limits>

namespace coagula::diagnose {

namespace {

constexpr double free_deviation = 1e3;  ///< of what follows freely, in standard errors of the numbers together

/// The fit with all that follows a remainder.
struct Start {
    Prediction prediction;
    Eigen::MatrixXd following;  ///< whitened directions of stiffness and parameters, of unit deviation
};

/// The prediction at the known stiffness, about which it may differ by its error, as far as a straight line from that of the fit
/// leads there: what follows does so along such lines.
Prediction about_known_stiffness(const Inference& inference, const Model& model) {
    constexpr double step = 1e-4;
    const Forward& forward = inference.forward();
    Prediction prediction = forward.prediction(model);
    const double known = known_scale(forward.experiment()).value;
    if (std::isfinite(known)) {
        Model beside = model;
        beside.settings.normal_stiffness *= std::exp(step);
        const double way = std::log(known / model.settings.normal_stiffness) / step;
        prediction.values += way * (forward.predict(beside) - prediction.values);
    }
    return prediction;
}

Start start_of(const Inference& inference, const Fit& fit) {
    const double error = inference.stiffness_error();
    const Eigen::MatrixXd slopes = inference.jacobian(fit);
    const auto parameters = static_cast<Index>(fit.active_end.size());
    std::vector<Eigen::VectorXd> columns;
    for (Index column = 0; column <= parameters; ++column) {
        const Eigen::VectorXd slope = slopes.col(column);
        const bool stays = column > 0 && fit.active_end[static_cast<std::size_t>(column) - 1];
        if (stays || slope.norm() == 0) {
            continue;
        }
        columns.emplace_back(column == 0 && std::isfinite(error) ? Eigen::VectorXd(error * slope)
                                                                 : Eigen::VectorXd(free_deviation / slope.norm() * slope));
    }
    Start start{about_known_stiffness(inference, fit.model), Eigen::MatrixXd(slopes.rows(), static_cast<Index>(columns.size()))};
    for (std::size_t k = 0; k < columns.size(); ++k) {
        start.following.col(static_cast<Index>(k)) = columns[k];
    }
    return start;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& first, const Eigen::MatrixXd& second) {
    Eigen::MatrixXd both(first.rows(), first.cols() + second.cols());
    both << first, second;
    return both;
}

/// Most probable departure along some directions beside what follows.
Eigen::VectorXd departure_along(const ErrorModel& errors, const Start& start, const Eigen::MatrixXd& factor) {
    const Eigen::MatrixXd directions = errors.directions(start.prediction);
    const Index samples = errors.data().samples();
    const Eigen::MatrixXd others =
        beside(beside(directions.rightCols(directions.cols() - samples), start.following), errors.data().noise.whitened(factor));
    const Eigen::VectorXd level = directions.leftCols(samples).rowwise().sum();
    const Eigen::VectorXd plain = errors.whiten(errors.data().values - start.prediction.values);
    const std::vector<std::size_t> together(static_cast<std::size_t>(plain.size()), 0);
    NormalEffects effects(plain, level, errors.data().sample, samples, others, together, 1);
    effects.solve(errors.data().effect, Eigen::VectorXd::Ones(others.cols()), {1.0});
    return factor * effects.most_probable().tail(factor.cols());
}

}  // namespace

SmoothRemainder find_remainder(const Inference& inference, const Fit& fit, const SmoothDepartures& departures) {
    const ErrorModel& errors = inference.errors();
    const Start start = start_of(inference, fit);
    const double alone = errors.log_density(start.prediction, start.following);
    const Eigen::VectorXd level = complex_moduli(errors.data().observations, inference.fitted(start.prediction));
    SmoothRemainder found;
    double best = -std::numeric_limits<double>::infinity();
    Eigen::MatrixXd best_factor;
    std::vector<double> all;
    for (const std::vector<SmoothDeparture>& group : departures) {
        std::vector<double> members;
        for (const SmoothDeparture& departure : group) {
            const Eigen::MatrixXd factor = level.asDiagonal() * departure.factor;
            const Eigen::MatrixXd white = errors.data().noise.whitened(factor);
            for (const double amplitude : smooth_amplitudes) {
                members.push_back(errors.log_density(start.prediction, beside(start.following, amplitude * white)) - alone);
                if (members.back() > best) {
                    best = members.back();
                    found.along = departure.along;
                    best_factor = amplitude * factor;
                }
            }
        }
        all.push_back(log_mean(members));
    }
    found.log_factor = log_mean(all);
    found.directions = errors.data().noise.whitened(best_factor);
    found.departure = departure_along(errors, start, best_factor);
    return found;
}

double log_factor_along(const Inference& inference, const Fit& fit, const Eigen::MatrixXd& directions) {
    const ErrorModel& errors = inference.errors();
    const Start start = start_of(inference, fit);
    return errors.log_density(start.prediction, beside(start.following, directions)) -
           errors.log_density(start.prediction, start.following);
}

}  // namespace coagula::diagnose
