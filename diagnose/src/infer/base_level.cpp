// SPDX-License-Identifier: GPL-3.0-or-later
// The stiffness that a model needs.
#include "hypothesis.hpp"

#include "data/median.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace coagula::diagnose {

double Inference::log_level(Model model) const {
    const std::vector<Observation>& observations = errors_.data().observations;
    for (int round = 0; round < 2; ++round) {  // an instrument does not scale
        const Eigen::VectorXd predicted = forward_.predict(model);
        std::vector<double> ratios;
        for (std::size_t k = 0; k < observations.size(); ++k) {
            const double ratio = observations[k].value / predicted[static_cast<Index>(k)];
            if (forward_.scales(observations[k]) && ratio > 0 && std::isfinite(ratio)) {
                ratios.push_back(ratio);
            }
        }
        model.settings.normal_stiffness *= ratios.empty() ? 1.0 : median(std::move(ratios));
    }
    return std::log(model.settings.normal_stiffness);
}

std::vector<Inference::MeasuredSize> Inference::measured_sizes() const {
    const DataSet& data = errors_.data();
    // A smooth material follows the data itself, and an oil has one modulus.
    const bool network = forward_.experiment().material.kind == MaterialKind::network;
    if (!network || !scales_ || std::isfinite(stiffness_departure(0))) {
        return {};
    }
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Index>> rows;
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        const Observation& one = data.observations[k];
        if (forward_.scales(one)) {
            rows[{one.measurement, one.row}].push_back(static_cast<Index>(k));
        }
    }
    std::vector<MeasuredSize> all;
    for (auto& [row, observations] : rows) {
        const double size = data.values(observations).norm();
        if (size > 0) {
            all.push_back({std::move(observations), std::log(size)});
        }
    }
    return all;
}

/// A model whose level is free lies among the data. Where it predicts next to nothing, their errors, which are in proportion to
/// what was measured, ask for the size of a modulus only and not for its phase: the density has a plateau there that may be higher
/// than anywhere else. So it falls off where the predicted |G*| is smaller or larger by more than a factor of e, as a geometric
/// mean.
double Inference::log_prior_of_level(const Eigen::VectorXd& predicted) const {
    constexpr double most = 1;
    constexpr double deviation = 0.1;
    double sum = 0;
    double count = 0;
    for (const MeasuredSize& size : sizes_) {
        const double square = predicted(size.observations).squaredNorm();
        sum += square > 0 ? 0.5 * std::log(square) - size.logarithm : 0;
        count += square > 0 ? 1 : 0;
    }
    const double beyond = std::max(0.0, std::abs(sum) / std::max(count, 1.0) - most) / deviation;
    return -0.5 * beyond * beyond;
}

/// Far from the data the density has long tails, in which a search may stay: it begins where the model lies among the data, or
/// where it was before if that is not far from there, nearer to the data, or the prediction is nonlinear.
double Inference::better_start(const Model& model, double before) const {
    constexpr double far = 0.5;
    if (!scales_ || forward_.is_nonlinear(model)) {
        return before;
    }
    const double level = log_level(model);
    if (std::abs(level - before) < far) {
        return before;
    }
    const auto density = [&](double place) { return density_at(model, place, Accuracy::middle); };
    return density(level) > density(before) ? level : before;
}

/// Where part of the rows lies far off, the density of the base model has several maxima along the stiffness: the highest one. One
/// at the ends of what log_prior_of_level() allows counts only where there is no other: the plateau ends there, and no number that
/// was measured says so.
/// @param density by the logarithm of the stiffness. @return place and value.
std::pair<double, double> Inference::highest_maximum(const std::function<double(double)>& density) const {
    constexpr double step = 0.1;
    constexpr int steps = 15;       // to either side
    constexpr double among = 0.75;  // the data, from their level: not at the ends
    constexpr int digits = 20;
    std::vector<double> places;
    std::vector<double> values;
    for (int number = -steps; number <= steps; ++number) {
        places.push_back(log_level_ + number * step);
        values.push_back(density(places.back()));
    }
    auto highest = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
    if (std::abs(places[highest] - log_level_) > among) {
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 1; k + 1 < values.size(); ++k) {
            const bool is_maximum = values[k] >= values[k - 1] && values[k] >= values[k + 1];
            if (is_maximum && std::abs(places[k] - log_level_) <= among && values[k] > most) {
                highest = k;
                most = values[k];
            }
        }
    }
    const double place = places[highest];
    const auto misfit = [&](double there) { return -density(there); };
    const auto [top, least] = boost::math::tools::brent_find_minima(misfit, place - step, place + step, digits);
    return -least > values[highest] ? std::pair(top, -least) : std::pair(place, values[highest]);
}

double Inference::density_of_free_level() const {
    return highest_maximum([&](double there) { return density_at(Model{}, there) - log_prior(there); }).second;
}

}  // namespace coagula::diagnose
