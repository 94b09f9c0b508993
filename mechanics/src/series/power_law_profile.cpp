// SPDX-License-Identifier: GPL-3.0-or-later
#include "power_law_profile.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>

namespace coagula::mechanics {

namespace {

// The sums of squares of what lies within these stay in the range of numbers.
constexpr double largest_a = 1e6;  // of either sign
constexpr double smallest_modulus = 1e-60;
constexpr double largest_modulus = 1e60;
constexpr double resolved = 1e-12;  // of the range of a, at which two values still are two
constexpr std::uintmax_t most_iterations = 200;

std::string objection_to_value(double value, const char* object, Index structure) {
    const std::string is =
        "the " + std::string(object) + " of structure " + std::to_string(structure + 1) + " is " + to_text(value);
    if (!(std::isfinite(value) && value > 0)) {
        return is + " Pa, but must be finite and positive";
    }
    return value >= smallest_modulus && value <= largest_modulus
               ? std::string{}
               : is + " Pa, but must lie between " + to_text(smallest_modulus) + " and " + to_text(largest_modulus) + " Pa";
}

/// A sentence about two values that lie too close for the range of all; empty where there are none. @param a rising, all different.
std::string objection_to_spacing(const std::set<double>& a) {
    const double range = *a.rbegin() - *a.begin();
    const auto close =
        std::adjacent_find(a.begin(), a.end(), [&](double one, double next) { return next - one < resolved * range; });
    return close == a.end() ? std::string{}
                            : "the degrees of heterogeneity " + to_text(*close) + " and " + to_text(*std::next(close)) +
                                  " are the same within rounding beside the range of all, " + to_text(range);
}

std::string objection_to_values(const PowerLawData& data) {
    for (Index k = 0; k < data.a.size(); ++k) {
        if (!(std::abs(data.a[k]) <= largest_a)) {
            return "the degree of heterogeneity of structure " + std::to_string(k + 1) + " is " + to_text(data.a[k]) +
                   ", but must lie between " + to_text(-largest_a) + " and " + to_text(largest_a);
        }
        if (std::string sentence = objection_to_value(data.modulus[k], "modulus", k); !sentence.empty()) {
            return sentence;
        }
        if (data.standard_error.size() > 0) {
            if (std::string sentence = objection_to_value(data.standard_error[k], "standard error", k); !sentence.empty()) {
                return sentence;
            }
        }
    }
    return {};
}

}  // namespace

std::string objection_to(const PowerLawData& data) {
    const Index count = data.a.size();
    if (data.modulus.size() != count || (data.standard_error.size() != 0 && data.standard_error.size() != count)) {
        return "a power law needs one modulus (and one standard error or none at all) for each of the " + std::to_string(count) +
               " structures";
    }
    if (count < 3) {
        return "a power law has three parameters and needs at least three structures, but there are " + std::to_string(count);
    }
    if (std::string sentence = objection_to_values(data); !sentence.empty()) {
        return sentence;
    }
    const std::set<double> values(data.a.begin(), data.a.end());
    if (values.size() < 3) {
        return "a power law has three parameters and needs three different degrees of heterogeneity, but there are only " +
               std::to_string(values.size());
    }
    if (data.a.maxCoeff() - data.a.minCoeff() <= 1e-8 * data.a.cwiseAbs().maxCoeff()) {
        return "the degrees of heterogeneity differ by rounding only: all are " + to_text(data.a[0]);
    }
    if (std::string sentence = objection_to_spacing(values); !sentence.empty()) {
        return sentence;
    }
    if (data.modulus.maxCoeff() - data.modulus.minCoeff() <= 1e-12 * data.modulus.maxCoeff()) {
        return "the modulus is " + to_text(data.modulus[0]) +
               " Pa for every degree of heterogeneity: such data have no exponent and no critical value";
    }
    return {};
}

ProfiledSquares::ProfiledSquares(const PowerLawData& data) {
    std::map<double, std::vector<Index>> groups;
    for (Index k = 0; k < data.a.size(); ++k) {
        groups[data.a[k]].push_back(k);
    }
    const auto size = static_cast<Index>(groups.size());
    a_.resize(size);
    modulus_ = weight_ = Eigen::VectorXd::Zero(size);
    const auto weight_of = [&data](Index k) { return data.standard_error.size() > 0 ? std::pow(data.standard_error[k], -2) : 1.0; };
    Index next = 0;
    for (const auto& [a, members] : groups) {
        a_[next] = a;
        for (const Index k : members) {
            weight_[next] += weight_of(k);
            modulus_[next] += weight_of(k) * data.modulus[k];
        }
        modulus_[next] /= weight_[next];
        for (const Index k : members) {
            scatter_ += weight_of(k) * std::pow(data.modulus[k] - modulus_[next], 2);
        }
        ++next;
    }
}

/// The problem at one a0: the law as amplitude times shape, the shape 1 at the end where it is largest.
struct ProfiledSquares::Elimination {
    const ProfiledSquares& data;
    Eigen::ArrayXd log_distance;  // ln(a - a0), rising

    double largest_at(double beta) const { return beta >= 0 ? log_distance[log_distance.size() - 1] : log_distance[0]; }

    Eigen::ArrayXd shape(double beta) const { return (beta * (log_distance - largest_at(beta))).exp(); }

    /// The least squares solution for the factor of the shape.
    double amplitude(const Eigen::ArrayXd& g) const {
        const Eigen::ArrayXd weighted = data.weight_.array() * g;
        return (weighted * data.modulus_.array()).sum() / (weighted * g).sum();
    }

    double squares(double beta) const {
        const Eigen::ArrayXd g = shape(beta);
        return (data.weight_.array() * (data.modulus_.array() - amplitude(g) * g).square()).sum();
    }

    /// The best beta lies between the smallest and the largest logarithmic slope of neighbours: were it less than all of them,
    /// the residuals would rise from negative to positive, and a larger beta would lower them.
    std::pair<double, double> bracket() const {
        const Index last = log_distance.size() - 1;
        const Eigen::ArrayXd log_modulus = data.modulus_.array().log();
        const Eigen::ArrayXd slopes =
            (log_modulus.tail(last) - log_modulus.head(last)) / (log_distance.tail(last) - log_distance.head(last));
        return {slopes.minCoeff(), slopes.maxCoeff()};
    }

    /// There may be two minima, with the lowest structure and without it. They differ by more than a fraction of 1 / ln(ratio of
    /// the distances), which sets the steps; slopes of almost equal a, which may be huge, are reached in growing steps.
    double best_beta() const {
        const double unit = 1 / (log_distance[log_distance.size() - 1] - log_distance[0]);
        const auto [low, high] = bracket();
        const double first = std::asinh(low / unit);
        const double span = std::asinh(high / unit) - first;
        const int steps = std::max(2, static_cast<int>(std::ceil(span / 0.1)));
        const auto beta_at = [&](double step) { return unit * std::sinh(first + span * step / steps); };
        int best = 0;
        double least = squares(beta_at(0));
        for (int step = 1; step <= steps; ++step) {
            if (const double value = squares(beta_at(step)); value < least) {
                best = step;
                least = value;
            }
        }
        constexpr int all_bits = 52;
        std::uintmax_t iterations = most_iterations;
        return boost::math::tools::brent_find_minima([this](double beta) { return squares(beta); }, beta_at(std::max(best - 1, 0)),
                                                     beta_at(std::min(best + 1, steps)), all_bits, iterations)
            .first;
    }
};

PowerLaw ProfiledSquares::best_at(double a0) const {
    const Elimination problem{*this, (a_.array() - a0).log()};
    PowerLaw law;
    law.a0 = a0;
    law.beta = problem.best_beta();
    law.log_c = std::log(problem.amplitude(problem.shape(law.beta))) - law.beta * problem.largest_at(law.beta);
    law.sum_of_squares = problem.squares(law.beta) + scatter_;
    return law;
}

}  // namespace coagula::mechanics
