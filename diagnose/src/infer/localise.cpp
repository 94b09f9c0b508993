// SPDX-License-Identifier: GPL-3.0-or-later
#include "localise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

constexpr double noticeable = 2.5;  ///< standardised score

std::string three_digits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

std::string value_text(double value, Coordinate coordinate) {
    switch (coordinate) {
        case Coordinate::strain:
            return three_digits(100 * value) + " %";
        case Coordinate::angular_frequency:
            return three_digits(value) + " rad/s";
        case Coordinate::shear_rate:
            return three_digits(value) + " 1/s";
        case Coordinate::time:
            return three_digits(value) + " s";
        case Coordinate::gap:
            return three_digits(1e3 * value) + " mm";
        case Coordinate::pore_radius:
            return three_digits(1e6 * value) + " um";
        case Coordinate::distance:
            return three_digits(value) + " diameters";
        default:
            return three_digits(value);
    }
}

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

/// How many standard deviations off, in which direction.
std::string deviations_text(double score) {
    return three_digits(std::abs(score)) + " standard deviations " + (score > 0 ? "above" : "below");
}

/// Of one number that should be standard normal: unit information against none, as for a smooth departure.
double log_bayes_factor_of(double score) {
    return 0.25 * score * score - 0.5 * std::numbers::ln2;
}

/// What differs as a whole: the modulus from that of a known stiffness (where nothing else stands out, however little, for then it
/// is what the test found), samples from each other.
void add_departures_of_level(const Inference& inference, const Fit& base, const Prediction& prediction,
                             std::vector<Failure>& failures) {
    const double least = failures.empty() ? 0.0 : noticeable;
    const double stiffness = base.model.settings.normal_stiffness;
    const Experiment& experiment = inference.forward().experiment();
    const double known = known_scale(experiment).value;
    const bool newtonian = experiment.material.kind == MaterialKind::newtonian;
    const std::string unit = newtonian ? " Pa.s" : " N/m";
    if (const double score = inference.stiffness_departure(std::log(stiffness)); std::abs(score) >= least) {
        failures.push_back(
            {.observable = newtonian ? "loss_modulus" : "storage_modulus",
             .axis = newtonian ? "viscosity" : "normal_stiffness",
             .log_bayes_factor = log_bayes_factor_of(score),
             .from = stiffness,
             .departure = stiffness / known - 1,
             .sentence =
                 std::string(newtonian ? "the level asks for a viscosity of " : "the level of G' asks for a normal stiffness of ") +
                 three_digits(stiffness) + unit + ", " + deviations_text(score) + " the known " + three_digits(known) + unit});
    }
    const DataSet& data = inference.errors().data();
    if (data.samples() < 2 || data.effect <= 0) {
        return;
    }
    const Eigen::VectorXd effects = inference.errors().effects(prediction);
    for (Index sample = 0; sample < data.samples(); ++sample) {
        const double score = effects[sample] / data.effect;
        if (std::abs(score) >= noticeable) {
            failures.push_back({.observable = "storage_modulus",
                                .axis = "sample",
                                .log_bayes_factor = log_bayes_factor_of(score),
                                .from = static_cast<double>(sample + 1),
                                .departure = effects[sample],
                                .sentence = "sample '" + data.sample_names[static_cast<std::size_t>(sample)] +
                                            "' as a whole lies " + three_digits(100 * std::abs(effects[sample])) + " %, " +
                                            deviations_text(score) + " the base model"});
        }
    }
}

/// What images of the same particles differ by, which the base model knows nothing of.
void add_departures_of_images(const std::vector<Observation>& observations, const Eigen::VectorXd& prediction,
                              std::vector<Failure>& failures) {
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& one = observations[k];
        const auto* images = as<ImageDifference>(one);
        const double departure = one.value - prediction[static_cast<Index>(k)];
        const double score = departure / one.standard_error;
        if (images == nullptr || score < noticeable) {
            continue;
        }
        const bool unmatched = images->quantity == ImageQuantity::unmatched;
        failures.push_back(
            {.observable = std::string(observable_of(one).key),
             .axis = "frame",
             .log_bayes_factor = log_bayes_factor_of(score),
             .from = unset,
             .departure = departure,
             .sentence = unmatched ? three_digits(100 * one.value) + " % of the centres of an image are not in the next one"
                                   : "images of the same particles scatter: a centre by " + three_digits(one.value) +
                                         " diameters " + (images->quantity == ImageQuantity::plane ? "in the plane" : "along z")});
        failures.back().sentence += ", " + deviations_text(score) + " exact centres";
    }
}

/// Which way the measured values go from the early ones to the late ones, against a base model that may be zero.
std::string way_of(double early, double late, bool of_base_zero) {
    if (of_base_zero) {
        return late < 0 ? " falls below the base model" : " rises above the base model";
    }
    return late < early ? " falls relative to the base model" : " rises relative to the base model";
}

/// Whether the departure is the same all along.
bool is_level(double early, double late) {
    return early * late > 0 && std::abs(late - early) < 0.2 * std::abs(early);
}

/// Whether tables state the times of these rows.
bool is_clocked(const MisfitStatistic& statistic, const Experiment& experiment, const std::vector<Observation>& observations) {
    return std::all_of(statistic.rows.begin(), statistic.rows.end(), [&](Index row) {
        const std::size_t table = observations[static_cast<std::size_t>(row)].measurement;
        return find_column(experiment.measurements[table], "time") != nullptr;
    });
}

/// An axis in words.
std::string spoken_axis(const MisfitStatistic& statistic, bool clocked) {
    if (statistic.coordinate == Coordinate::angular_frequency) {
        return "angular frequency";
    }
    return statistic.coordinate == Coordinate::time && !clocked ? "time (10 s a row where none is stated)"
                                                                : std::string(name_of(statistic.coordinate));
}

/// A smooth departure along an axis.
Failure departure_along(const MisfitStatistic& statistic, const Experiment& experiment,
                        const std::vector<Observation>& observations, const Eigen::VectorXd& residual,
                        const Eigen::VectorXd& prediction) {
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
    Failure failure;
    failure.observable = statistic.observable;
    failure.axis = name_of(statistic.coordinate);
    // Three components with a unit-information prior against none (Kass and Wasserman 1995).
    failure.log_bayes_factor = 0.5 * (statistic.value - 3 * std::log(static_cast<double>(statistic.rows.size())));
    failure.from = places[place];
    failure.departure = late;
    const std::string axis = spoken_axis(statistic, is_clocked(statistic, experiment, observations));
    const std::string whole(of_scale ? "the largest predicted modulus" : observable.whole);
    const std::string of = whole.empty() ? "" : " (of " + whole + ")";
    const std::string subject(observable.phrase);
    if (is_level(early, late)) {
        failure.sentence = subject + " lies " + (late < 0 ? "below" : "above") + " the base model all along " + axis +
                           ": mean difference " + three_digits(100 * 0.5 * (early + late)) + " %" + of;
    } else {
        failure.sentence = subject + way_of(early, late, of_base_zero) + " along " + axis + ": mean difference " +
                           three_digits(100 * early) + " % before and " + three_digits(100 * late) + " % from " +
                           value_text(failure.from, statistic.coordinate) + " on" + of;
    }
    return failure;
}

}  // namespace

std::vector<Failure> localise(const Inference& inference, const Fit& base, const Detection& detection) {
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
    std::vector<Failure> failures;
    const Experiment& experiment = inference.forward().experiment();
    const auto add = [&](const MisfitStatistic& one) {
        Failure found = departure_along(one, experiment, observations, residual, prediction);
        if (std::none_of(failures.begin(), failures.end(),
                         [&](const Failure& other) { return other.sentence == found.sentence; })) {
            failures.push_back(std::move(found));
        }
    };
    const auto is_told = [&](const MisfitStatistic& one) {
        return std::any_of(failures.begin(), failures.end(),
                           [&](const Failure& other) { return other.observable == one.observable; });
    };
    std::vector<const MisfitStatistic*> by_rows;  // along a time that nobody has stated
    for (const MisfitStatistic* statistic : along) {
        if (statistic->score < noticeable) {
            continue;
        }
        const bool clocked = statistic->coordinate != Coordinate::time || is_clocked(*statistic, experiment, observations);
        clocked ? add(*statistic) : by_rows.push_back(statistic);
    }
    for (const MisfitStatistic* statistic : by_rows) {
        if (!is_told(*statistic)) {
            add(*statistic);
        }
    }
    add_departures_of_level(inference, base, fitted, failures);
    add_departures_of_images(observations, inference.fitted(fitted), failures);
    if (failures.empty() && !along.empty()) {
        add(*along.front());
    }
    return failures;
}

namespace {

/// Numbers of one observable that a remainder moves, and how far, over |G*|.
struct Moved {
    std::vector<Index> rows;
    Eigen::VectorXd share;  ///< of every number
    Index largest = 0;
};

Moved moved_by(const SmoothRemainder& remainder, const DataSet& data, const Eigen::VectorXd& prediction) {
    Moved moved;
    moved.share = (remainder.departure.array() / complex_moduli(data.observations, prediction).max(1e-300)).matrix();
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

std::string place_of(const SmoothRemainder& remainder, const DataSet& data, const Eigen::VectorXd& prediction) {
    const Moved moved = moved_by(remainder, data, prediction);
    const auto& observations = data.observations;
    std::string text = std::string(observable_of(observations[static_cast<std::size_t>(moved.largest)]).phrase) + " lies " +
                       (moved.share[moved.largest] < 0 ? "below" : "above") + " the model by up to " +
                       three_digits(100 * std::abs(moved.share[moved.largest])) + " % of |G*|";
    for (const Coordinate coordinate : remainder.along) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (const Index row : moved.rows) {
            const double place = coordinate_of(observations[static_cast<std::size_t>(row)], coordinate);
            low = std::isfinite(place) ? std::min(low, place) : low;
            high = std::isfinite(place) ? std::max(high, place) : high;
        }
        if (low <= high) {
            const std::string axis = coordinate == Coordinate::angular_frequency ? "angular frequency" : name_of(coordinate);
            text += (text.find(", at ") == std::string::npos ? ", at " : " and ") + axis + " " + value_text(low, coordinate) +
                    (high > low ? " to " + value_text(high, coordinate) : "");
        }
    }
    return text;
}

}  // namespace coagula::diagnose
