#include "localise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

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
            return three_digits(value / (2 * std::numbers::pi)) + " Hz";
        case Coordinate::time:
            return three_digits(value) + " s";
        case Coordinate::gap:
            return three_digits(1e3 * value) + " mm";
        case Coordinate::pore_radius:
            return three_digits(1e6 * value) + " um";
        default:
            return three_digits(value);
    }
}

/// An observable in words.
std::string spoken(const std::string& observable) {
    if (observable == "neighbours") {
        return "the number of neighbours";
    }
    if (observable == "exclusion_probability") {
        return "the share of the void space in larger pores";
    }
    if (observable.starts_with("third_harmonic")) {
        return observable.ends_with("loss") ? "the viscous part of the third harmonic" : "the elastic part of the third harmonic";
    }
    return observable == "loss_modulus" ? "G''" : "G'";
}

/// The row from which on the residuals differ most from those before.
std::size_t change_point(const std::vector<Index>& rows, const Eigen::VectorXd& residual) {
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
        if (k >= 1 && contrast > best) {
            best = contrast;
            place = k + 1;
        }
    }
    return place;
}

/// Mean of measured less predicted over the size of the prediction of |G*|; of a probability as it stands.
double mean_departure(const std::vector<Observation>& observations, const Eigen::VectorXd& prediction,
                      const std::vector<Index>& rows, std::size_t from, std::size_t to, bool loss, double scale) {
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) {
        const double expected = prediction[rows[k]];
        const Observation& one = observations[static_cast<std::size_t>(rows[k])];
        sum += (one.value - expected) / (loss ? scale : relative_to(one, expected));
    }
    return sum / static_cast<double>(std::max<std::size_t>(1, to - from));
}

}  // namespace

std::vector<Failure> localise(const std::vector<Observation>& observations, const Detection& detection,
                              const Eigen::VectorXd& residual, const Eigen::VectorXd& prediction) {
    std::vector<Failure> failures;
    const double scale = prediction.cwiseAbs().maxCoeff();
    for (const MisfitStatistic& statistic : detection.statistics) {
        if (statistic.coordinate == Coordinate::none || !statistic.cause.empty() || statistic.autocorrelation ||
            (statistic.score < noticeable && !failures.empty())) {
            continue;
        }
        const bool loss = statistic.observable == "loss_modulus";
        const bool of_base_zero = statistic.observable.starts_with("third_harmonic");
        const std::size_t place = change_point(statistic.rows, residual);
        const double early = mean_departure(observations, prediction, statistic.rows, 0, place, loss, scale);
        const double late = mean_departure(observations, prediction, statistic.rows, place, statistic.rows.size(), loss, scale);
        Failure failure;
        failure.observable = statistic.observable;
        failure.axis = name_of(statistic.coordinate);
        // Smooth departure of three components with a unit-information prior against none (Kass and Wasserman 1995).
        failure.bayes_factor =
            std::exp(std::min(700.0, 0.5 * (statistic.value - 3 * std::log(static_cast<double>(statistic.rows.size())))));
        failure.from = coordinate_of(observations[static_cast<std::size_t>(statistic.rows[place])], statistic.coordinate);
        failure.departure = late;
        failure.sentence = spoken(statistic.observable) + (late < (of_base_zero ? 0.0 : early) ? " falls below" : " rises above") +
                           " the base model along " +
                           (statistic.coordinate == Coordinate::angular_frequency ? "frequency" : failure.axis) +
                           ": mean difference " + three_digits(100 * early) + " % before and " + three_digits(100 * late) +
                           " % from " + value_text(failure.from, statistic.coordinate) + " on" +
                           (loss                                              ? " (of the largest predicted modulus)"
                            : of_base_zero                                    ? " (of the first)"
                            : statistic.coordinate == Coordinate::pore_radius ? " (of the void space)"
                                                                              : "");
        failures.push_back(std::move(failure));
    }
    return failures;
}

}  // namespace coagula::diagnose
