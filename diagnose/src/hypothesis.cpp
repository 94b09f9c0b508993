#include "hypothesis.hpp"

#include "weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;

constexpr double log_stiffness_range = 13.8;  // of 0.1 .. 1e5 N/m
constexpr double relevant = 14;               // logarithms below the best node that count
constexpr int most_rounds = 8;
constexpr int posterior_draws = 64;

/// Nodes along an axis for so many parameters.
int nodes_for(std::size_t parameters) {
    constexpr std::array<int, 5> nodes{1, 41, 15, 9, 7};
    return parameters < nodes.size() ? nodes.at(parameters) : 5;
}

/// A box of the prior, 0 .. 1 along each axis.
struct Box {
    std::vector<double> low;
    std::vector<double> high;

    double at(std::size_t axis, int node, int nodes) const { return low[axis] + (high[axis] - low[axis]) * (node + 0.5) / nodes; }
    double log_cell(int nodes) const {
        double sum = 0;
        for (std::size_t axis = 0; axis < low.size(); ++axis) {
            sum += std::log((high[axis] - low[axis]) / nodes);
        }
        return sum;
    }
};

/// The places along all axes of node number `number`.
std::vector<int> split(std::size_t number, std::size_t axes, int nodes) {
    std::vector<int> place(axes);
    for (std::size_t axis = 0; axis < axes; ++axis) {
        place[axis] = static_cast<int>(number % static_cast<std::size_t>(nodes));
        number /= static_cast<std::size_t>(nodes);
    }
    return place;
}

/// The value below which a part of the weight lies.
double quantile(std::vector<std::pair<double, double>> values_and_weights, double part) {
    std::sort(values_and_weights.begin(), values_and_weights.end());
    double total = 0;
    for (const auto& entry : values_and_weights) {
        total += entry.second;
    }
    double below = 0;
    for (const auto& [value, weight] : values_and_weights) {
        below += weight;
        if (below >= part * total) {
            return value;
        }
    }
    return values_and_weights.back().first;
}

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

double Inference::stiffness_departure(double log_stiffness) const {
    const Sample& sample = forward_.experiment().sample;
    return (log_stiffness - std::log(sample.normal_stiffness)) / sample.normal_stiffness_error;
}

double Inference::log_prior(double log_stiffness) const {
    const double departure = stiffness_departure(log_stiffness);
    return std::isnan(departure)
               ? -std::log(log_stiffness_range)
               : -0.5 * departure * departure - std::log(forward_.experiment().sample.normal_stiffness_error * std::sqrt(2 * pi));
}

/// Gauss and Newton's method for the logarithm of the stiffness: the prediction's logarithmic derivative by a difference, the
/// density along it by itself.
Inference::Node Inference::best_stiffness(Settings settings, double start) const {
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
        const Eigen::VectorXd slope_of_prediction = (predict(place + step) - here) / step;
        const auto density = [&](double offset) {
            return likelihood_.log_density(here + offset * slope_of_prediction) + log_prior(place + offset);
        };
        best = density(0);
        const double above = density(step);
        const double below = density(-step);
        const double slope = (above - below) / (2 * step);
        curvature = (2 * best - above - below) / (step * step);
        longest *= slope * slope_before < 0 ? 0.4 : 1.0;
        slope_before = slope;
        const double change = curvature > 0 ? slope / curvature : std::copysign(longest, slope);
        const double moved = std::clamp(place + std::clamp(change, -longest, longest), std::log(0.1), std::log(1e5));
        const bool done = std::abs(moved - place) < 1e-3 / std::sqrt(std::max(curvature, 1.0)) + 1e-9;
        if (done) {
            break;
        }
        place = moved;
    }
    curvature = std::max(curvature, 1e-2);
    return {place, 1 / std::sqrt(curvature), best, best + 0.5 * std::log(2 * pi / curvature)};
}

Fit Inference::fit(const Hypothesis& hypothesis) const {
    const std::vector<MechanismParameter> parameters = parameters_of(hypothesis);
    const std::size_t axes = parameters.size();
    const int nodes = nodes_for(axes);
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        count *= static_cast<std::size_t>(nodes);
    }
    const auto settings_at = [&](const Box& box, const std::vector<int>& place) {
        Settings settings;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            settings.*parameters[axis].value = parameters[axis].at(box.at(axis, place[axis], nodes));
        }
        return settings;
    };

    Box box{std::vector<double>(axes, 0.0), std::vector<double>(axes, 1.0)};
    std::vector<Node> grid(count);
    std::vector<double> weights(count);
    double start = std::log(100.0);
    for (int round = 0; round < most_rounds; ++round) {
        for (std::size_t number = 0; number < count; ++number) {
            grid[number] = best_stiffness(settings_at(box, split(number, axes, nodes)), start);
            start = grid[number].log_stiffness;
            weights[number] = grid[number].log_weight;
        }
        const double largest = *std::max_element(weights.begin(), weights.end());
        Box next = box;
        bool smaller = false;
        for (std::size_t axis = 0; axis < axes; ++axis) {
            int first = nodes;
            int last = -1;
            for (std::size_t number = 0; number < count; ++number) {
                if (weights[number] > largest - relevant) {
                    const int place = split(number, axes, nodes)[axis];
                    first = std::min(first, place);
                    last = std::max(last, place);
                }
            }
            const double cell = (box.high[axis] - box.low[axis]) / nodes;
            next.low[axis] = std::max(box.low[axis], box.low[axis] + cell * (first - 1));
            next.high[axis] = std::min(box.high[axis], box.low[axis] + cell * (last + 2));
            smaller = smaller || next.high[axis] - next.low[axis] < 0.6 * (box.high[axis] - box.low[axis]);
        }
        if (!smaller) {
            break;
        }
        if (round + 1 < most_rounds) {
            box = next;
        }
    }

    Fit fit;
    fit.hypothesis = hypothesis;
    fit.log_evidence = log_sum(weights) + box.log_cell(nodes);
    const auto best = static_cast<std::size_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    fit.settings = settings_at(box, split(best, axes, nodes));
    fit.settings.normal_stiffness = std::exp(grid[best].log_stiffness);
    fit.log_density = grid[best].log_density;

    std::vector<double> probability(count);
    std::transform(weights.begin(), weights.end(), probability.begin(), [&](double w) { return std::exp(w - weights[best]); });
    for (std::size_t axis = 0; axis < axes; ++axis) {
        std::vector<std::pair<double, double>> marginal;
        for (std::size_t number = 0; number < count; ++number) {
            marginal.emplace_back(box.at(axis, split(number, axes, nodes)[axis], nodes), probability[number]);
        }
        // A node stands for its cell.
        const double half = 0.5 * (box.high[axis] - box.low[axis]) / nodes;
        fit.parameters.push_back({fit.settings.*parameters[axis].value, parameters[axis].at(quantile(marginal, 0.05) - half),
                                  parameters[axis].at(quantile(marginal, 0.95) + half)});
    }
    const double spread = 1.645 * grid[best].deviation;
    fit.stiffness = {fit.settings.normal_stiffness, fit.settings.normal_stiffness * std::exp(-spread),
                     fit.settings.normal_stiffness * std::exp(spread)};

    // Draws at equal steps of the cumulated probability.
    fit.draws.resize(static_cast<Index>(axes) + 1, posterior_draws);
    const double total = std::accumulate(probability.begin(), probability.end(), 0.0);
    double below = 0;
    std::size_t number = 0;
    for (int draw = 0; draw < posterior_draws; ++draw) {
        while (number + 1 < count && below + probability[number] < (draw + 0.5) / posterior_draws * total) {
            below += probability[number++];
        }
        fit.draws(0, draw) = std::exp(grid[number].log_stiffness);
        for (std::size_t axis = 0; axis < axes; ++axis) {
            fit.draws(static_cast<Index>(axis) + 1, draw) =
                parameters[axis].at(box.at(axis, split(number, axes, nodes)[axis], nodes));
        }
    }
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
    // Sample effects are fitted, too.
    const Eigen::MatrixXd effects = likelihood_.effect_directions(forward_.predict(fit.settings));
    Eigen::MatrixXd all(slopes.rows(), slopes.cols() + effects.cols());
    all << slopes, effects;
    return all;
}

}  // namespace coagula::diagnose
