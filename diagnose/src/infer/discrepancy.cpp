// SPDX-License-Identifier: GPL-3.0-or-later
#include "discrepancy.hpp"

#include "noise/low_rank.hpp"
#include "posterior_grid.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/common/random.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace coagula::diagnose {

namespace {

constexpr double normal_half_width = 1.645;  ///< of 90 %, in standard deviations
constexpr double free_deviation = 1;         ///< of what follows freely: a logarithm, or the place in the whole of a prior

/// A model about which a discrepancy is looked for, with all that follows one along straight lines.
struct Start {
    Fit fit;
    Prediction prediction{Eigen::VectorXd{}};
    std::vector<Index> follow;   ///< 0: the logarithm of the stiffness; from 1 on the places of the parameters
    Eigen::VectorXd deviations;  ///< of these
    Eigen::MatrixXd following;   ///< what they do to the whitened numbers, of unit deviation
};

/// The prediction at the known stiffness, about which it may differ by its error, as far as a straight line from that of the fit
/// leads there: what follows does so along such lines. @param further as in Inference::prediction.
Prediction about_known_stiffness(const Inference& inference, const Model& model, const Eigen::MatrixXd& further) {
    constexpr double step = 1e-4;
    const Forward& forward = inference.forward();
    Prediction prediction = inference.prediction(model, further);
    const double known = known_scale(forward.experiment()).value;
    if (std::isfinite(known)) {
        Model beside = model;
        beside.settings.normal_stiffness *= std::exp(step);
        const double way = std::log(known / model.settings.normal_stiffness) / step;
        prediction.values += way * (forward.predict(beside, prediction.errors.linearised_at) - prediction.values);
    }
    return prediction;
}

/// About another fit of the same, with the deviations that it has already. @param further as in Inference::prediction.
void move_to(Start& start, const Inference& inference, Fit fit, const Eigen::MatrixXd& further) {
    start.fit = std::move(fit);
    start.prediction = about_known_stiffness(inference, start.fit.model, further);
    start.following = inference.jacobian(start.fit, further)(Eigen::all, start.follow) * start.deviations.asDiagonal();
}

/// The prediction of a start beside further departures, which leave less to its own errors.
Prediction beside_departures(const Inference& inference, const Start& start, const Eigen::MatrixXd& further) {
    const bool nonlinear = inference.forward().is_nonlinear(start.fit.model);
    return nonlinear ? about_known_stiffness(inference, start.fit.model, further) : start.prediction;
}

Start start_of(const Inference& inference, const Fit& fit) {
    const double error = inference.stiffness_error();
    const Eigen::MatrixXd slopes = inference.jacobian(fit);
    Start start;
    std::vector<double> deviations;
    for (Index column = 0; column <= static_cast<Index>(fit.active_end.size()); ++column) {
        const double slope = slopes.col(column).norm();
        // A smooth material follows by its own functions; a line along a parameter beside them leads out of its range.
        const bool stays = inference.forward().is_smooth() || (column > 0 && fit.active_end[static_cast<std::size_t>(column) - 1]);
        if (!stays && slope > 0) {
            start.follow.push_back(column);
            deviations.push_back(column == 0 && std::isfinite(error) ? error : free_deviation);
        }
    }
    start.deviations = Eigen::Map<const Eigen::VectorXd>(deviations.data(), static_cast<Index>(deviations.size()));
    move_to(start, inference, fit, {});
    return start;
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& first, const Eigen::MatrixXd& second) {
    Eigen::MatrixXd both(first.rows(), first.cols() + second.cols());
    both << first, second;
    return both;
}

/// Most probable values, with their covariance, of what follows and of a departure along some directions.
struct Followed {
    Eigen::VectorXd moved;       ///< of what follows, in its own units
    Eigen::MatrixXd covariance;  ///< of these
    Eigen::VectorXd departure;   ///< of every number
};

Followed followed(const Inference& inference, const Start& start, const Eigen::MatrixXd& factor) {
    const ErrorModel& errors = inference.errors();
    const Eigen::MatrixXd apart = beside(start.following, errors.data().noise.whitened(factor));
    const Prediction prediction = beside_departures(inference, start, apart);
    const Eigen::MatrixXd directions = errors.directions(prediction);
    const Index samples = errors.data().samples();
    const Index follow = start.following.cols();
    const Eigen::MatrixXd others = beside(directions.rightCols(directions.cols() - samples), apart);
    const Eigen::VectorXd level = directions.leftCols(samples).rowwise().sum();
    const Eigen::VectorXd plain = errors.whiten(errors.data().values - prediction.without_errors());
    const std::vector<std::size_t> together(static_cast<std::size_t>(plain.size()), 0);
    NormalEffects effects(std::make_shared<Belonging>(errors.data().sample, samples, together, 1), plain, level, others);
    effects.solve(errors.data().effect, Eigen::VectorXd::Ones(others.cols()), {1.0});
    const Index first = directions.cols();
    return {
        start.deviations.cwiseProduct(effects.most_probable().segment(first, follow)),
        start.deviations.asDiagonal() * effects.covariance().block(first, first, follow, follow) * start.deviations.asDiagonal(),
        factor * effects.most_probable().tail(factor.cols())};
}

/// Stiffness and parameters, in their order, where what follows has moved by so much.
Eigen::VectorXd values_at(const Inference& inference, const Start& start, const Eigen::VectorXd& moved) {
    constexpr double longest = 2;  // of the logarithm of the stiffness
    const std::vector<MechanismParameter> parameters = parameters_of(start.fit.hypothesis);
    const double known = known_scale(inference.forward().experiment()).value;
    Eigen::VectorXd values(static_cast<Index>(parameters.size()) + 1);
    values << start.fit.model.settings.normal_stiffness, Eigen::VectorXd::Map(start.fit.values().data(), values.size() - 1);
    for (std::size_t k = 0; k < start.follow.size(); ++k) {
        const double change = moved[static_cast<Index>(k)];
        double& value = values[start.follow[k]];
        if (start.follow[k] == 0) {
            value = (std::isfinite(known) ? known : value) * std::exp(std::clamp(change, -longest, longest));
        } else {
            const MechanismParameter& parameter = parameters[static_cast<std::size_t>(start.follow[k]) - 1];
            value = parameter.at(std::clamp(parameter.place_of(value) + change, prior_edge, 1 - prior_edge));
        }
    }
    return values;
}

/// A parameter that a normal posterior, of which the prior cuts off a part, leads to.
Estimate within_prior(const MechanismParameter& parameter, double value, double place, double deviation) {
    const auto [low, high] = middle_within_prior(place, deviation, 0.9);
    return {value, std::min(value, parameter.at(low)), std::max(value, parameter.at(high))};
}

/// Whether the data would have more of it than its prior: a tenth of the range beyond its end is more probable by an e-fold.
bool leads_beyond_prior(double place, double deviation) {
    constexpr double beyond = 0.1;
    return std::max(-place, place - 1) * beyond > deviation * deviation;
}

/// The fit where the model beside a departure would have it, and how well it is determined there. What does not follow keeps the
/// posterior that it has by itself.
Fit moved_fit(const Inference& inference, const Start& start, const Followed& beside) {
    const std::vector<MechanismParameter> parameters = parameters_of(start.fit.hypothesis);
    const Eigen::VectorXd deviation = beside.covariance.diagonal().cwiseSqrt();
    const Eigen::VectorXd middle = values_at(inference, start, beside.moved);
    const Eigen::VectorXd rest = middle.tail(middle.size() - 1);
    Fit fit = start.fit;
    fit.model = Model(fit.hypothesis, Values(rest.data(), static_cast<std::size_t>(rest.size())), middle[0]);
    for (std::size_t k = 0; k < start.follow.size(); ++k) {
        const double sigma = deviation[static_cast<Index>(k)];
        const double value = middle[start.follow[k]];
        if (start.follow[k] == 0) {
            const double factor = std::exp(normal_half_width * sigma);
            fit.stiffness = {value, value / factor, value * factor};
            continue;
        }
        const auto number = static_cast<std::size_t>(start.follow[k]) - 1;
        const double place = parameters[number].place_of(start.fit.values()[number]) + beside.moved[static_cast<Index>(k)];
        fit.parameters[number] = within_prior(parameters[number], value, place, sigma);
        fit.active_end[number] = leads_beyond_prior(place, sigma) || place < prior_edge || place > 1 - prior_edge;
    }
    return fit;
}

/// Equally probable draws from the normal posterior of what follows.
Eigen::MatrixXd draws_of(const Inference& inference, const Start& start, const Followed& beside) {
    const Eigen::MatrixXd root = beside.covariance.llt().matrixL();
    Eigen::MatrixXd draws = start.fit.draws;
    for (Index draw = 0; draw < draws.cols(); ++draw) {
        Eigen::VectorXd normal(beside.moved.size());
        for (Index k = 0; k < normal.size(); ++k) {
            normal[k] =
                random_normal(0, RandomPurpose::diagnosis, static_cast<std::uint64_t>(draw), static_cast<std::uint64_t>(k))[0];
        }
        draws(start.follow, draw) = values_at(inference, start, beside.moved + root * normal)(start.follow);
    }
    return draws;
}

/// Density of the data without a discrepancy. Where part of the data lies far off, the integral over what follows may find a
/// lower maximum than the fit has found, and a nonlinear prediction other errors; then the density that the fit has found counts.
double density_alone(const ErrorModel& errors, const Start& start) {
    const Index follow = start.following.cols();
    const Eigen::MatrixXd precision = Eigen::MatrixXd::Identity(follow, follow) + start.following.transpose() * start.following;
    const double log_width = -precision.llt().matrixLLT().diagonal().array().log().sum();
    const double at_fit = std::max(start.fit.log_density, errors.log_density(start.prediction));
    return std::max(errors.log_density(start.prediction, start.following), at_fit + log_width);
}

/// Density of the data beside a departure in these whitened directions, for every amplitude.
std::vector<double> densities_beside(const Inference& inference, const Start& start, const Eigen::MatrixXd& white) {
    const ErrorModel& errors = inference.errors();
    if (!inference.forward().is_nonlinear(start.fit.model)) {
        return errors.log_densities(start.prediction, beside(start.following, white), white.cols(), smooth_amplitudes);
    }
    std::vector<double> densities;
    for (const double amplitude : smooth_amplitudes) {
        const Eigen::MatrixXd further = beside(start.following, amplitude * white);
        densities.push_back(errors.log_density(beside_departures(inference, start, further), further));
    }
    return densities;
}

/// Finds the best of all departures at a start.
Discrepancy discrepancy_at(const Inference& inference, const Start& start, const SmoothDepartures& departures, double alone) {
    const ErrorModel& errors = inference.errors();
    const Eigen::VectorXd level = complex_moduli(errors.data().observations, inference.fitted(start.prediction));
    Discrepancy found{.fit = start.fit};
    std::vector<double> all;
    for (const std::vector<SmoothDeparture>& group : departures) {
        std::vector<double> members;
        for (const SmoothDeparture& departure : group) {
            const Eigen::MatrixXd factor = level.asDiagonal() * departure.factor;
            const std::vector<double> densities = densities_beside(inference, start, errors.data().noise.whitened(factor));
            for (std::size_t k = 0; k < densities.size(); ++k) {
                members.push_back(densities[k] - alone);
                if (members.back() > found.best) {
                    found.best = members.back();
                    found.along = departure.along;
                    found.factor = smooth_amplitudes[k] * factor;
                }
            }
        }
        all.push_back(log_mean(members));
    }
    found.log_factor = log_mean(all);
    return found;
}

}  // namespace

Discrepancy find_discrepancy(const Inference& inference, const Fit& fit, const SmoothDepartures& departures) {
    const ErrorModel& errors = inference.errors();
    Start start = start_of(inference, fit);
    const double alone = density_alone(errors, start);
    Discrepancy found = discrepancy_at(inference, start, departures, alone);
    Followed at_best = followed(inference, start, found.factor);
    // Far from there neither the lines nor the amplitudes, shares of the level, are right.
    constexpr int rounds = 2;
    for (int round = 0; round < rounds; ++round) {
        Start moved = start;
        move_to(moved, inference, moved_fit(inference, start, at_best),
                beside(start.following, errors.data().noise.whitened(found.factor)));
        Discrepancy there = discrepancy_at(inference, moved, departures, alone);
        if (!(there.best > found.best)) {
            break;
        }
        start = std::move(moved);
        found = std::move(there);
        at_best = followed(inference, start, found.factor);
    }
    found.fit = moved_fit(inference, start, at_best);
    found.fit.log_density = errors.log_density(inference.prediction(found.fit.model));
    found.fit.draws = draws_of(inference, start, at_best);
    found.directions = errors.data().noise.whitened(found.factor);
    found.departure = at_best.departure;
    return found;
}

DeparturesAlong departures_along(const Inference& inference, const Fit& fit, const std::vector<Eigen::MatrixXd>& directions) {
    const ErrorModel& errors = inference.errors();
    const Start start = start_of(inference, fit);
    const double alone = density_alone(errors, start);
    std::vector<double> all;
    double best = -std::numeric_limits<double>::infinity();
    Eigen::MatrixXd factor;
    for (const Eigen::MatrixXd& one : directions) {
        const std::vector<double> densities = densities_beside(inference, start, errors.data().noise.whitened(one));
        for (std::size_t k = 0; k < densities.size(); ++k) {
            all.push_back(densities[k] - alone);
            if (all.back() > best) {
                best = all.back();
                factor = smooth_amplitudes[k] * one;
            }
        }
    }
    return {log_mean(all), followed(inference, start, factor).departure};
}

double log_factor_along(const Inference& inference, const Fit& fit, const Eigen::MatrixXd& directions) {
    const ErrorModel& errors = inference.errors();
    const Start start = start_of(inference, fit);
    const Eigen::MatrixXd further = beside(start.following, directions);
    return errors.log_density(beside_departures(inference, start, further), further) - density_alone(errors, start);
}

}  // namespace coagula::diagnose
