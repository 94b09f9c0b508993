// SPDX-License-Identifier: GPL-3.0-or-later
#include "localise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double noticeable = 2.5;  ///< standardised score

/// The row from which on the residuals differ most from those before; rows at one place stay together.
std::size_t change_point(const std::vector<Index>& rows, const Eigen::VectorXd& residual, const std::vector<double>& places) {
    double total = 0;
    for (const Index row : rows) {
        total += residual[row];
    }
    double before = 0;
    double best = -1;
    std::size_t place = 0;
    const auto count = static_cast<double>(rows.size());
    for (std::size_t k = 0; k + 2 < rows.size(); ++k) {
        before += residual[rows[k]];
        const auto left = static_cast<double>(k + 1);
        const double contrast =
            std::abs(before / left - (total - before) / (count - left)) * std::sqrt(left * (count - left) / count);
        if (k >= 1 && places[k] != places[k + 1] && contrast > best) {
            best = contrast;
            place = k + 1;
        }
    }
    return place;
}

/// Mean of measured less predicted over the size of the prediction of |G*|; of a probability as it stands.
double mean_departure(const std::vector<Observation>& observations, const Eigen::VectorXd& prediction,
                      const std::vector<Index>& rows, std::size_t from, std::size_t to, bool of_scale, double scale) {
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) {
        const double expected = prediction[rows[k]];
        const Observation& one = observations[static_cast<std::size_t>(rows[k])];
        sum += (one.value - expected) / (of_scale ? scale : relative_to(one, expected));
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, to - from));
}

/// Bayes factor of one number that should be standard normal: unit information against none, as for a smooth departure.
double log_bayes_factor_of(double score) {
    return 0.25 * score * score - 0.5 * std::numbers::ln2;
}

/// What differs as a whole: the modulus from that of a known stiffness (where nothing else stands out, however little, for then it
/// is what the test found), samples from each other.
void add_departures_of_level(const Inference& inference, const Fit& base, const Prediction& prediction,
                             std::vector<Misfit>& misfits) {
    const double least = misfits.empty() ? 0.0 : noticeable;
    const double stiffness = base.model.settings.normal_stiffness;
    const Experiment& experiment = inference.forward().experiment();
    const double known = known_scale(experiment).value;
    const bool newtonian = experiment.material.kind == MaterialKind::newtonian;
    if (const double score = inference.stiffness_departure(std::log(stiffness)); std::abs(score) >= least) {
        misfits.push_back({.observable = newtonian ? "loss_modulus" : "storage_modulus",
                           .axis = newtonian ? "viscosity" : "normal_stiffness",
                           .log_bayes_factor = log_bayes_factor_of(score),
                           .from = stiffness,
                           .departure = stiffness / known - 1,
                           .what = LevelMisfit{known, score}});
    }
    const DataSet& data = inference.errors().data();
    if (data.samples() < 2 || data.effect <= 0) {
        return;
    }
    const Eigen::VectorXd effects = inference.errors().effects(prediction);
    for (Index sample = 0; sample < data.samples(); ++sample) {
        const double score = effects[sample] / data.effect;
        if (std::abs(score) >= noticeable) {
            misfits.push_back({.observable = "storage_modulus",
                               .axis = "sample",
                               .log_bayes_factor = log_bayes_factor_of(score),
                               .from = static_cast<double>(sample + 1),
                               .departure = effects[sample],
                               .what = SampleMisfit{data.sample_names[static_cast<std::size_t>(sample)], score}});
        }
    }
}

/// What images of the same particles differ by, which the base model knows nothing of.
void add_departures_of_images(const std::vector<Observation>& observations, const Eigen::VectorXd& prediction,
                              std::vector<Misfit>& misfits) {
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& one = observations[k];
        const double departure = one.value - prediction[static_cast<Index>(k)];
        const double score = departure / one.standard_error;
        if (is<ImageDifference>(one) && score >= noticeable) {
            misfits.push_back({.observable = std::string(observable_of(one).key),
                               .axis = "frame",
                               .log_bayes_factor = log_bayes_factor_of(score),
                               .from = unset,
                               .departure = departure,
                               .what = ImageMisfit{one.value, score}});
        }
    }
}

/// Whether the departure is the same all along.
bool is_level(double early, double late) {
    return early * late > 0 && std::abs(late - early) < 0.2 * std::abs(early);
}

/// Whether tables state the times of these rows, if it goes along the time.
bool is_clocked(const MisfitStatistic& statistic, const Experiment& experiment, const std::vector<Observation>& observations) {
    return statistic.coordinate != Coordinate::time || std::all_of(statistic.rows.begin(), statistic.rows.end(), [&](Index row) {
               const std::size_t table = observations[static_cast<std::size_t>(row)].measurement;
               return find_column(experiment.measurements[table], "time") != nullptr;
           });
}

/// A smooth departure along an axis.
Misfit departure_along(const MisfitStatistic& statistic, const Experiment& experiment, const std::vector<Observation>& observations,
                       const Eigen::VectorXd& residual, const Eigen::VectorXd& prediction) {
    const double scale = prediction.cwiseAbs().maxCoeff();
    const Observable& observable = observable_named(statistic.observable);
    const bool of_base_zero =
        std::all_of(statistic.rows.begin(), statistic.rows.end(), [&](Index row) { return prediction[row] == 0; });
    const bool of_scale = observable.key == "loss_modulus" || (observable.unit == "Pa" && of_base_zero);
    std::vector<double> places;
    for (const Index row : statistic.rows) {
        places.push_back(coordinate_of(observations[static_cast<std::size_t>(row)], statistic.coordinate));
    }
    const std::size_t place = change_point(statistic.rows, residual, places);
    const double early = mean_departure(observations, prediction, statistic.rows, 0, place, of_scale, scale);
    const double late = mean_departure(observations, prediction, statistic.rows, place, statistic.rows.size(), of_scale, scale);
    return {.observable = statistic.observable,
            .axis = name_of(statistic.coordinate),
            // Three components with a unit-information prior against none (Kass and Wasserman 1995).
            .log_bayes_factor = 0.5 * (statistic.value - 3 * std::log(static_cast<double>(statistic.rows.size()))),
            .from = places[place],
            .departure = late,
            .what = SmoothMisfit{.before = early,
                                 .over_largest = of_scale,
                                 .base_is_zero = of_base_zero,
                                 .time_is_stated = is_clocked(statistic, experiment, observations),
                                 .is_the_same = is_level(early, late)}};
}

}  // namespace

std::vector<Misfit> localise(const Inference& inference, const Fit& base, const Detection& detection) {
    const std::vector<Observation>& observations = inference.errors().data().observations;
    const Prediction fitted = inference.prediction(base.model);
    const Eigen::VectorXd prediction = inference.as_fitted(fitted);  // that of the residuals, and of the curve that the page draws
    const Eigen::VectorXd residual = inference.errors().residual(fitted);
    std::vector<const MisfitStatistic*> along;
    for (const MisfitStatistic& statistic : detection.statistics) {
        if (statistic.coordinate != Coordinate::none && statistic.cause.empty() && !statistic.autocorrelation) {
            along.push_back(&statistic);
        }
    }
    std::vector<Misfit> misfits;
    const Experiment& experiment = inference.forward().experiment();
    const auto add = [&](const MisfitStatistic& one) {
        misfits.push_back(departure_along(one, experiment, observations, residual, prediction));
    };
    const auto is_told = [&](const MisfitStatistic& one) {
        return std::any_of(misfits.begin(), misfits.end(), [&](const Misfit& other) { return other.observable == one.observable; });
    };
    std::vector<const MisfitStatistic*> by_rows;  // along a time that nobody has stated
    for (const MisfitStatistic* statistic : along) {
        if (statistic->score < noticeable) {
            continue;
        }
        is_clocked(*statistic, experiment, observations) ? add(*statistic) : by_rows.push_back(statistic);
    }
    for (const MisfitStatistic* statistic : by_rows) {
        if (!is_told(*statistic)) {
            add(*statistic);
        }
    }
    add_departures_of_level(inference, base, fitted, misfits);
    add_departures_of_images(observations, inference.fitted(fitted), misfits);
    if (misfits.empty() && !along.empty()) {
        add(*along.front());
    }
    return misfits;
}

namespace {

/// Numbers of one observable that a discrepancy moves, and how far, over |G*|.
struct Moved {
    std::vector<Index> rows;
    Eigen::VectorXd share;  ///< of every number
    Index largest = 0;
};

Moved moved_by(const Discrepancy& discrepancy, const DataSet& data, const Eigen::VectorXd& prediction) {
    Moved moved;
    moved.share = (discrepancy.departure.array() / complex_moduli(data.observations, prediction).max(1e-300)).matrix();
    moved.share.cwiseAbs().maxCoeff(&moved.largest);
    const Observable& observable = observable_of(data.observations[static_cast<std::size_t>(moved.largest)]);
    constexpr double part = 0.5;
    for (Index row = 0; row < data.size(); ++row) {
        if (&observable_of(data.observations[static_cast<std::size_t>(row)]) == &observable &&
            moved.share[row] * moved.share[moved.largest] > 0 &&
            std::abs(moved.share[row]) > part * std::abs(moved.share[moved.largest])) {
            moved.rows.push_back(row);
        }
    }
    return moved;
}

}  // namespace

void place(const Discrepancy& departing, const DataSet& data, const Eigen::VectorXd& prediction, Remainder& remainder) {
    const Moved moved = moved_by(departing, data, prediction);
    remainder.observable = observable_of(data.observations[static_cast<std::size_t>(moved.largest)]).key;
    remainder.largest = moved.share[moved.largest];
    for (const Coordinate coordinate : departing.along) {
        CoordinateRange range{name_of(coordinate), std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
        for (const Index row : moved.rows) {
            const double place = coordinate_of(data.observations[static_cast<std::size_t>(row)], coordinate);
            range.low = std::isfinite(place) ? std::min(range.low, place) : range.low;
            range.high = std::isfinite(place) ? std::max(range.high, place) : range.high;
        }
        if (range.low <= range.high) {
            remainder.where.push_back(range);
        }
    }
}

}  // namespace coagula::diagnose
