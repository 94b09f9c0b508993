#include "hypothesis.hpp"

#include "departures.hpp"
#include "weights.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

constexpr double softest = 1e-3;  ///< particle [N/m]: fresh pastes of some pascal
constexpr double stiffest = 1e5;
constexpr double log_stiffness_range = 18.42;  ///< of these
constexpr int posterior_draws = 64;

/// Nodes per axis that a grid must count for, effectively, to have seen the posterior.
constexpr double enough_nodes = 2.5;

}  // namespace

std::string name_of(const Hypothesis& hypothesis) {
    std::string name;
    for (const Mechanism* mechanism : hypothesis) {
        name += (name.empty() ? "" : " + ") + mechanism->name;
    }
    return name.empty() ? "base" : name;
}

std::vector<MechanismParameter> parameters_of(const Hypothesis& hypothesis) {
    std::vector<MechanismParameter> all;
    for (const Mechanism* mechanism : hypothesis) {
        all.insert(all.end(), mechanism->parameters.begin(), mechanism->parameters.end());
    }
    return all;
}

double Inference::stiffness_error() const {
    const double stated = forward_.experiment().sample.normal_stiffness_error;
    return std::isnan(stated) ? stated : std::hypot(stated, forward_.level_error());
}

double Inference::stiffness_departure(double log_stiffness) const {
    const Sample& sample = forward_.experiment().sample;
    return (log_stiffness - std::log(sample.normal_stiffness)) / stiffness_error();
}

double Inference::log_prior(double log_stiffness) const {
    const double departure = stiffness_departure(log_stiffness);
    return std::isnan(departure) ? -std::log(log_stiffness_range)
                                 : -0.5 * departure * departure - std::log(stiffness_error() * std::sqrt(2 * pi));
}

/// Gauss and Newton's method for the logarithm of the stiffness: the prediction's logarithmic derivative by a difference, the
/// density along it by itself.
Node Inference::best_stiffness(Settings settings, double start) const {
    constexpr double step = 1e-3;
    const auto predict = [&](double log_stiffness) {
        settings.normal_stiffness = std::exp(log_stiffness);
        return forward_.predict(settings);
    };
    double place = start;
    double best = 0;
    double curvature = 1;
    double longest = 1;  // step; shorter each time that the slope turns, for the density has long tails
    double slope_before = 0;
    for (int iteration = 0; iteration < 40; ++iteration) {
        const Eigen::VectorXd here = predict(place);
        const Eigen::MatrixXd errors = forward_.yield_errors(settings);
        const Eigen::VectorXd slope_of_prediction = (predict(place + step) - here) / step;
        const auto density = [&](double offset) {
            return likelihood_.log_density(here + offset * slope_of_prediction, errors) + log_prior(place + offset);
        };
        best = density(0);
        const double above = density(step);
        const double below = density(-step);
        const double slope = (above - below) / (2 * step);
        curvature = (2 * best - above - below) / (step * step);
        longest *= slope * slope_before < 0 ? 0.4 : 1.0;
        slope_before = slope;
        const double change = curvature > 0 ? slope / curvature : std::copysign(longest, slope);
        const double moved = std::clamp(place + std::clamp(change, -longest, longest), std::log(softest), std::log(stiffest));
        const bool done = std::abs(moved - place) < 1e-3 / std::sqrt(std::max(curvature, 1.0)) + 1e-9;
        if (done) {
            break;
        }
        place = moved;
    }
    curvature = std::max(curvature, 1e-2);
    return {place, 1 / std::sqrt(curvature), best, best + 0.5 * std::log(2 * pi / curvature)};
}

Settings Inference::settings_at(const std::vector<MechanismParameter>& parameters, const Eigen::VectorXd& place) {
    Settings settings;
    for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
        settings.*parameters[axis].value = parameters[axis].at(place[static_cast<Index>(axis)]);
    }
    return settings;
}

/// Gauss and Newton's method from a place of the prior for stiffness, parameters and sample effects together, kept inside the
/// prior; then the grid about what it finds, by the covariance of the parameters.
std::optional<PosteriorGrid> Inference::grid_about_mode(const Hypothesis& hypothesis, Eigen::VectorXd place,
                                                        const EvaluateNode& evaluate) const {
    const std::vector<MechanismParameter> parameters = parameters_of(hypothesis);
    const Index axes = place.size();
    Node here = evaluate(place);
    Eigen::MatrixXd covariance;
    for (int iteration = 0; iteration < 30; ++iteration) {
        Fit fit{.hypothesis = hypothesis, .settings = settings_at(parameters, place), .parameters = {}, .draws = {}};
        fit.settings.normal_stiffness = std::exp(here.log_stiffness);
        const Departures departures = departures_of(*this, fit);
        const Eigen::MatrixXd information = departures.jacobian.transpose() * departures.jacobian;
        const Eigen::LDLT<Eigen::MatrixXd> factor(information);
        if (factor.info() != Eigen::Success || factor.rcond() < 1e-13) {
            return std::nullopt;  // not all parameters are determined
        }
        covariance = factor.solve(Eigen::MatrixXd::Identity(information.rows(), information.cols())).block(1, 1, axes, axes);
        const Eigen::VectorXd step = factor.solve(departures.jacobian.transpose() * departures.residual).segment(1, axes);
        bool better = false;
        for (double part = 1; part > 1e-3 && !better; part *= 0.5) {
            const Eigen::VectorXd moved = (place + part * step).cwiseMax(1e-3).cwiseMin(1 - 1e-3);
            const Node there = evaluate(moved);
            better = there.log_weight > here.log_weight + 1e-6;
            if (better) {
                place = moved;
                here = there;
            }
        }
        if (!better) {
            break;
        }
    }
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    if (root.info() != Eigen::Success) {
        return std::nullopt;
    }
    return diagnose::grid_about(place, root.matrixL(), evaluate);
}

PosteriorGrid Inference::grid_for(const Hypothesis& hypothesis) const {
    const std::vector<MechanismParameter> parameters = parameters_of(hypothesis);
    const auto axes = static_cast<Index>(parameters.size());
    double start = std::log(100.0);
    const auto evaluate = [&](const Eigen::VectorXd& place) {
        const Node node = best_stiffness(settings_at(parameters, place), start);
        start = node.log_stiffness;
        return node;
    };
    PosteriorGrid grid = grid_along_axes(axes, evaluate);
    if (axes > 1 && grid.effective_nodes() < std::pow(enough_nodes, axes)) {
        // A narrow ridge between the axes: the grid along these misses it.
        auto about = grid_about_mode(hypothesis, grid.places[grid.best()], evaluate);
        if (about && !about->nodes.empty() && about->nodes[about->best()].log_weight > grid.nodes[grid.best()].log_weight - 1) {
            return *about;
        }
    }
    return grid;
}

/// Draws at equal steps of the cumulated probability.
Eigen::MatrixXd Inference::draws_from(const PosteriorGrid& grid, const std::vector<MechanismParameter>& parameters) {
    std::vector<double> weights;
    for (const Node& node : grid.nodes) {
        weights.push_back(node.log_weight);
    }
    const std::vector<double> probability = probabilities_of(std::move(weights));
    Eigen::MatrixXd draws(static_cast<Index>(parameters.size()) + 1, posterior_draws);
    double below = 0;
    std::size_t number = 0;
    for (int draw = 0; draw < posterior_draws; ++draw) {
        while (number + 1 < grid.nodes.size() && below + probability[number] < (draw + 0.5) / posterior_draws) {
            below += probability[number++];
        }
        draws(0, draw) = std::exp(grid.nodes[number].log_stiffness);
        for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
            const auto row = static_cast<Index>(axis);
            draws(row + 1, draw) = parameters[axis].at(grid.places[number][row]);
        }
    }
    return draws;
}

Fit Inference::fit(const Hypothesis& hypothesis) const {
    const std::vector<MechanismParameter> parameters = parameters_of(hypothesis);
    const PosteriorGrid grid = grid_for(hypothesis);
    const std::size_t best = grid.best();
    const Node& node = grid.nodes[best];
    Fit fit{.hypothesis = hypothesis,
            .settings = settings_at(parameters, grid.places[best]),
            .parameters = {},
            .log_density = node.log_density,
            .log_evidence = grid.log_evidence(),
            .draws = draws_from(grid, parameters)};
    fit.settings.normal_stiffness = std::exp(node.log_stiffness);
    for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
        const auto row = static_cast<Index>(axis);
        fit.parameters.push_back({fit.settings.*parameters[axis].value, parameters[axis].at(grid.quantile(row, 0.05)),
                                  parameters[axis].at(grid.quantile(row, 0.95))});
    }
    const double spread = 1.645 * node.deviation;
    fit.stiffness = {fit.settings.normal_stiffness, fit.settings.normal_stiffness * std::exp(-spread),
                     fit.settings.normal_stiffness * std::exp(spread)};
    return fit;
}

Eigen::MatrixXd Inference::jacobian(const Fit& fit) const {
    const std::vector<MechanismParameter> parameters = parameters_of(fit.hypothesis);
    const Eigen::VectorXd here = likelihood_.whiten(forward_.predict(fit.settings));
    Eigen::MatrixXd slopes(here.size(), static_cast<Index>(parameters.size()) + 1);
    constexpr double step = 1e-4;
    Settings moved = fit.settings;
    moved.normal_stiffness *= std::exp(step);
    slopes.col(0) = (likelihood_.whiten(forward_.predict(moved)) - here) / step;
    for (std::size_t axis = 0; axis < parameters.size(); ++axis) {
        const MechanismParameter& parameter = parameters[axis];
        moved = fit.settings;
        const double place = parameter.place_of(fit.settings.*parameter.value);
        const double change = place > 0.5 ? -step : step;
        moved.*parameter.value = parameter.at(place + change);
        slopes.col(static_cast<Index>(axis) + 1) = (likelihood_.whiten(forward_.predict(moved)) - here) / change;
    }
    // Sample effects and the errors of the model are fitted, too.
    const Eigen::MatrixXd effects =
        likelihood_.effect_directions(forward_.predict(fit.settings), forward_.yield_errors(fit.settings));
    Eigen::MatrixXd all(slopes.rows(), slopes.cols() + effects.cols());
    all << slopes, effects;
    return all;
}

}  // namespace coagula::diagnose
