// SPDX-License-Identifier: GPL-3.0-or-later
#include "hypothesis.hpp"

#include <coagula/common/log_probability.hpp>
#include <coagula/common/special_functions.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

}  // namespace

Model model_at(const Hypothesis& hypothesis, const Eigen::VectorXd& place, double normal_stiffness) {
    std::vector<double> values;
    for (const MechanismParameter& parameter : parameters_of(hypothesis)) {
        values.push_back(parameter.at(place[static_cast<Index>(values.size())]));
    }
    return {hypothesis, values, normal_stiffness};
}

bool Inference::shows_scale() const {
    const auto& observations = errors_.data().observations;
    return std::any_of(observations.begin(), observations.end(), [&](const Observation& one) { return forward_.scales(one); });
}

double Inference::stiffness_error() const {
    const double stated = known_scale(forward_.experiment()).error;
    return std::isnan(stated) ? stated : std::hypot(stated, forward_.level_error());
}

bool Inference::level_is_open() const {
    const auto& observations = errors_.data().observations;
    return std::isnan(known_scale(forward_.experiment()).error) &&
           std::any_of(observations.begin(), observations.end(),
                       [](const Observation& one) { return is_modulus_or_viscosity(one) && one.structures == 0; });
}

double Inference::stiffness_departure(double log_stiffness) const {
    return (log_stiffness - std::log(known_scale(forward_.experiment()).value)) / stiffness_error();
}

double Inference::log_prior(double log_stiffness) const {
    const double departure = stiffness_departure(log_stiffness);
    return std::isnan(departure) ? -std::log(log_stiffness_range)
                                 : -0.5 * departure * departure - std::log(stiffness_error() * std::sqrt(2 * pi));
}

/// A function along the logarithm of the stiffness: its value, slope and curvature downwards, by differences.
struct Inference::AlongStiffness {
    double value;
    double slope;
    double curvature;

    double step() const { return curvature > 0 ? slope / curvature : std::copysign(1.0, slope); }
    double deviation() const { return 1 / std::sqrt(std::max(curvature, 1e-2)); }
    /// On the parabola, beside this place.
    double at(double offset) const { return value + slope * offset - 0.5 * curvature * offset * offset; }
    double log_width() const { return std::log(deviation() * std::sqrt(2 * pi)); }
};

/// Gauss and Newton's method, in steps of one standard error at most, shorter each time that it turns. A model that needs errors
/// that do not happen stands at the farthest that do.
Prediction Inference::prediction(const Model& model, const Eigen::MatrixXd& further, int most_steps) const {
    constexpr double converged = 0.1;  // standard errors: half of its square is what the density may lack
    constexpr double farthest = 8;     // all errors together
    if (!forward_.is_nonlinear(model)) {
        return forward_.prediction(model);
    }
    const bool near = last_errors_.size() == forward_.errors_of(model);
    Prediction here = near ? forward_.prediction(model, last_errors_) : forward_.prediction(model);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(here.errors.linearised_at.size());
    double longest = 1;
    for (int steps = 0; steps < most_steps; ++steps) {
        const Eigen::VectorXd& place = here.errors.linearised_at;
        const Eigen::VectorXd whole = errors_.effects(here, further).tail(place.size()) - place;
        longest *= whole.dot(step) < 0 ? 0.5 : 1.0;
        const Eigen::VectorXd next = place + std::min(1.0, longest / whole.norm()) * whole;
        step = std::min(1.0, farthest / next.norm()) * next - place;
        if (!(step.norm() > converged)) {
            break;
        }
        here = forward_.prediction(model, place + step);
    }
    last_errors_ = here.errors.linearised_at;
    return here;
}

/// The prediction by its logarithmic derivative, by a difference, the density by itself.
Inference::AlongStiffness Inference::density_along(Model model, double log_stiffness, Accuracy accuracy) const {
    constexpr double step = 1e-3;
    model.settings.normal_stiffness = std::exp(log_stiffness);
    // On the way the errors follow the stiffness; at its end they are found.
    constexpr int steps_on_the_way = 2;
    const Prediction here = prediction(model, {}, accuracy == Accuracy::whole ? many_steps : steps_on_the_way);
    const Prediction change = forward_.change_by_stiffness(model, here, step);
    const auto [below, value, above] = errors_.log_densities(here, change, accuracy);
    const double prior = log_prior(log_stiffness) + log_prior_of_level(here.values);
    const double prior_above = log_prior(log_stiffness + step) + log_prior_of_level(here.values + change.values) - prior;
    const double prior_below = log_prior(log_stiffness - step) + log_prior_of_level(here.values - change.values) - prior;
    const double rise = above - below + prior_above - prior_below;
    const double bend = 2 * value - above - below - prior_above - prior_below;
    return {value + prior, rise / (2 * step), bend / (step * step)};
}

/// Density at a stiffness. As a whole it may exceed that at the middle of the deviations by far, because the data may ask for
/// larger ones.
double Inference::density_at(Model model, double log_stiffness, Accuracy accuracy) const {
    model.settings.normal_stiffness = std::exp(log_stiffness);
    const Prediction here = prediction(model);
    return errors_.log_density(here, {}, accuracy) + log_prior(log_stiffness) + log_prior_of_level(here.values);
}

/// Newton's method for the logarithm of the stiffness, with the density as a whole near its end only. @param least log weight from
/// which on the node counts.
Node Inference::best_stiffness(const Model& model, double start, double least) const {
    if (!scales_) {
        const double density = errors_.log_density(prediction(model));
        return {start, 0, density, density};
    }
    constexpr int most_steps = 40;
    constexpr double near = 0.3;  // standard deviations, from where a parabola is exact enough
    Accuracy accuracy = Accuracy::middle;
    double place = start;
    double longest = 1;  // step; shorter each time that the slope turns, for the density has long tails
    AlongStiffness along{0, 0, 0};
    double slope_before = 0;
    for (int steps = 0; steps < most_steps; ++steps) {
        along = density_along(model, place, accuracy);
        longest *= along.slope * slope_before < 0 ? 0.4 : 1.0;
        slope_before = along.slope;
        const double moved = std::clamp(place + std::clamp(along.step(), -longest, longest), log_level_ - 0.5 * log_stiffness_range,
                                        log_level_ + 0.5 * log_stiffness_range);
        if (moved == place || (along.curvature > 0 && std::abs(moved - place) < near * along.deviation())) {
            double top = along.at(moved - place);
            if (accuracy == Accuracy::middle && top + along.log_width() < least) {
                top += density_at(model, place) - along.value;
            }
            if (accuracy == Accuracy::whole || top + along.log_width() < least) {
                return {moved, along.deviation(), top, top + along.log_width()};
            }
            accuracy = Accuracy::whole;
        }
        place = moved;
    }
    const double found = density_at(model, place);
    return {place, along.deviation(), found, found + along.log_width()};
}

/// Returns the node of the base model at its best stiffness, or at a higher maximum where there is one.
Node Inference::highest_of_base(const Node& found) const {
    if (!scales_) {
        return found;
    }
    const double place = highest_maximum([&](double there) { return density_at(Model{}, there); }).first;
    const AlongStiffness along = density_along(Model{}, place, Accuracy::whole);
    const Node highest{place, along.deviation(), along.value, along.value + along.log_width()};
    return highest.log_weight > found.log_weight ? highest : found;
}

/// Whether the data ask for more of a parameter than its prior has: a tenth of the range beyond its end they would be more probable
/// by an e-fold.
bool Inference::is_active_end(const Hypothesis& hypothesis, Eigen::VectorXd place, Index axis, double stiffness) const {
    constexpr double near = 0.01;
    constexpr double inside = 0.02;
    constexpr double beyond = 0.1;
    const bool low = place[axis] < near;
    if (!low && place[axis] < 1 - near) {
        return false;
    }
    const auto density = [&](double along) {
        place[axis] = along;
        return best_stiffness(model_at(hypothesis, place, 1), std::log(stiffness)).log_weight;
    };
    return (density(low ? 0.0 : 1.0) - density(low ? inside : 1 - inside)) * beyond / inside > 1;
}

Fit Inference::fit(const Hypothesis& hypothesis, const Engine& engine) const {
    return apart([&](const Inference& own) { return own.fit_here(hypothesis, engine); });
}

Fit Inference::fit_here(const Hypothesis& hypothesis, const Engine& engine) const {
    const std::vector<MechanismParameter> parameters = parameters_of(hypothesis);
    const Posterior posterior = engine(problem(hypothesis));
    const Eigen::VectorXd& place = posterior.place;
    const double stiffness = std::exp(posterior.node.log_stiffness);
    Fit fit{.hypothesis = hypothesis,
            .model = model_at(hypothesis, place, stiffness),
            .parameters = {},
            .log_density = posterior.node.log_density - (scales_ ? log_prior(posterior.node.log_stiffness) : 0.0),
            .log_evidence = posterior.log_evidence,
            .draws = posterior.draws};
    for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
        const auto row = static_cast<Index>(axis);
        const double value = parameters[axis].at(place[row]);
        fit.active_end.push_back(is_active_end(hypothesis, place, row, stiffness));
        fit.parameters.push_back({value, std::min(value, parameters[axis].at(posterior.quantile(row, 0.05))),
                                  std::max(value, parameters[axis].at(posterior.quantile(row, 0.95)))});
    }
    const double of_structures = level_is_open() ? forward_.level_error() : 0.0;
    const auto quantile = [&](double part) { return std::exp(posterior.log_stiffness_quantile(part, of_structures)); };
    fit.stiffness = {stiffness, std::min(stiffness, quantile(0.05)), std::max(stiffness, quantile(0.95))};
    return fit;
}

Eigen::MatrixXd Inference::jacobian(const Fit& fit, const Eigen::MatrixXd& further) const {
    const std::vector<MechanismParameter> parameters = parameters_of(fit.hypothesis);
    const Prediction about = prediction(fit.model, further);
    const Eigen::VectorXd here = errors_.whiten(about.values);
    Eigen::MatrixXd slopes(here.size(), static_cast<Index>(parameters.size()) + 1);
    constexpr double step = 1e-4;
    Model moved = fit.model;
    moved.settings.normal_stiffness *= std::exp(step);
    slopes.col(0) = (errors_.whiten(forward_.predict(moved, about.errors.linearised_at)) - here) / step;
    for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
        std::vector<double> values = fit.values();
        const double place = parameters[axis].place_of(values[axis]);
        const double change = place > 0.5 ? -step : step;
        values[axis] = parameters[axis].at(place + change);
        const Model beside(fit.hypothesis, values, fit.model.settings.normal_stiffness);
        slopes.col(static_cast<Index>(axis) + 1) =
            (errors_.whiten(forward_.predict(beside, about.errors.linearised_at)) - here) / change;
    }
    // Sample effects and the errors of the prediction are fitted, too.
    const Eigen::MatrixXd effects = errors_.directions(about);
    Eigen::MatrixXd all(slopes.rows(), slopes.cols() + effects.cols());
    all << slopes, effects;
    return all;
}

Eigen::VectorXd Inference::as_fitted(const Prediction& prediction) const {
    const DataSet& data = errors_.data();
    const Eigen::VectorXd effects = errors_.effects(prediction);
    Eigen::VectorXd values =
        prediction.without_errors() + prediction.errors.changes * effects.tail(prediction.errors.changes.cols());
    for (Index row = 0; row < values.size(); ++row) {
        const Index sample = data.sample[static_cast<std::size_t>(row)];
        values[row] += sample < 0 ? 0.0 : prediction.level_slope[row] * effects[sample];
    }
    return values;
}

}  // namespace coagula::diagnose
