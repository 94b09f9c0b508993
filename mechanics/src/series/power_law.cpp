// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/power_law.hpp>

#include <coagula/common/special_functions.hpp>

#include <Eigen/QR>
#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "power_law_profile.hpp"

namespace coagula::mechanics {

namespace {

/// Distances of a0 below the smallest a, in ranges of a.
constexpr double nearest = 1e-6;
constexpr double farthest = 30;

/// Turns a sum of squares into the confidence at which its a0 is excluded, and back.
struct Judgement {
    double least;   // smallest sum of squares
    Index freedom;  // degrees of freedom
    bool errors_known;

    /// With as many parameters as structures nothing tells how large the errors are.
    bool possible() const { return errors_known || freedom > 0; }

    double threshold(double confidence) const {
        const double quantile = (1 + confidence) / 2;
        if (errors_known) {
            return least + std::pow(normal_quantile(quantile), 2);
        }
        // F with 1 and m degrees of freedom is the square of Student's t with m.
        const auto m = static_cast<double>(freedom);
        return least * (1 + std::pow(student_quantile(m, quantile), 2) / m);
    }

    double confidence(double squares) const {
        const double excess = std::max(squares - least, 0.0);
        if (errors_known) {
            return std::erf(std::sqrt(excess / 2));
        }
        if (excess == 0 || least == 0) {
            return excess == 0 ? 0 : 1;
        }
        const auto m = static_cast<double>(freedom);
        return 1 - 2 * above_in_student(m, std::sqrt(excess / least * m));
    }
};

/// Laws at rising a0, with the place of the best.
struct Search {
    std::vector<PowerLaw> laws;
    std::size_t best = 0;
};

Search search(const ProfiledSquares& squares, Index points, const Progress& progress) {
    const auto at_distance = [&](double log_distance) {
        return squares.best_at(squares.smallest_a() - squares.range() * std::exp(log_distance));
    };
    const double first = std::log(farthest);
    const double step = (std::log(nearest) - first) / static_cast<double>(points - 1);
    Search found;
    for (Index k = 0; k < points; ++k) {
        found.laws.push_back(at_distance(first + step * static_cast<double>(k)));
        progress.update("fitting", static_cast<double>(k) / static_cast<double>(points));
    }
    const auto smaller = [](const PowerLaw& one, const PowerLaw& other) { return one.sum_of_squares < other.sum_of_squares; };
    found.best = static_cast<std::size_t>(std::min_element(found.laws.begin(), found.laws.end(), smaller) - found.laws.begin());
    if (found.best == 0 || found.best + 1 == found.laws.size()) {
        return found;
    }
    const double middle = first + step * static_cast<double>(found.best);
    constexpr int all_bits = 52;
    std::uintmax_t iterations = 200;
    const double distance = boost::math::tools::brent_find_minima([&](double x) { return at_distance(x).sum_of_squares; },
                                                                  middle + step, middle - step, all_bits, iterations)
                                .first;
    if (const PowerLaw refined = at_distance(distance); refined.sum_of_squares < found.laws[found.best].sum_of_squares) {
        const bool above = refined.a0 > found.laws[found.best].a0;
        found.best += above ? 1 : 0;
        found.laws.insert(found.laws.begin() + static_cast<std::ptrdiff_t>(found.best), refined);
    }
    return found;
}

/// Where the sum of squares passes the threshold between two values of a0.
double crossing(const ProfiledSquares& squares, double inside, double outside, double threshold) {
    for (int halving = 0; halving < 60; ++halving) {
        // Distances from the smallest a differ by orders of magnitude: halve their logarithm.
        const double middle = squares.smallest_a() - std::sqrt((squares.smallest_a() - inside) * (squares.smallest_a() - outside));
        (squares.best_at(middle).sum_of_squares <= threshold ? inside : outside) = middle;
    }
    return inside;
}

void add_interval(const ProfiledSquares& squares, const Search& found, double threshold, PowerLawFit& fit) {
    const auto within = [threshold](const PowerLaw& law) { return law.sum_of_squares <= threshold; };
    const auto& laws = found.laws;
    const auto first = std::find_if(laws.begin(), laws.end(), within);
    const auto last = std::find_if(laws.rbegin(), laws.rend(), within).base() - 1;
    fit.bounded_below = first != laws.begin();
    fit.bounded_above = last + 1 != laws.end();
    if (fit.bounded_below) {
        fit.a0_low = crossing(squares, first->a0, (first - 1)->a0, threshold);
    }
    if (fit.bounded_above) {
        fit.a0_high = crossing(squares, last->a0, (last + 1)->a0, threshold);
    }
}

/// Derivatives of the law by a0, beta and ln c, each row over the standard error.
Eigen::MatrixX3d sensitivity(const PowerLawData& data, const PowerLaw& law) {
    Eigen::MatrixX3d rows(data.a.size(), 3);
    for (Index k = 0; k < data.a.size(); ++k) {
        const double modulus = law.modulus(data.a[k]);
        const double distance = data.a[k] - law.a0;
        rows.row(k) << -law.beta * modulus / distance, modulus * std::log(distance), modulus;
        if (data.standard_error.size() > 0) {
            rows.row(k) /= data.standard_error[k];
        }
    }
    return rows;
}

void add_standard_errors(const PowerLawData& data, PowerLawFit& fit) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixX3d> factor(sensitivity(data, fit.law));
    if (factor.rank() < 3) {
        return;
    }
    const Eigen::Matrix3d root =
        factor.matrixR().topLeftCorner<3, 3>().triangularView<Eigen::Upper>().solve(Eigen::Matrix3d::Identity());
    const double variance =
        data.standard_error.size() > 0 ? 1 : fit.law.sum_of_squares / static_cast<double>(fit.degrees_of_freedom);
    const Eigen::Vector3d errors = factor.colsPermutation() * (root.rowwise().norm() * std::sqrt(variance));
    fit.a0_stderr = errors[0];
    fit.beta_stderr = errors[1];
    fit.log_c_stderr = errors[2];
}

PowerLawMinimum place_of(const Search& found) {
    if (found.best == 0) {
        return PowerLawMinimum::far_away;
    }
    return found.best + 1 == found.laws.size() ? PowerLawMinimum::lowest_a : PowerLawMinimum::inside;
}

struct FitWithProfile {
    PowerLawFit fit;
    PowerLawProfile profile;
};

FitWithProfile fit_once(const PowerLawData& data, const PowerLawOptions& options, const Progress& progress) {
    const ProfiledSquares squares(data);
    const Search found = search(squares, options.points, progress);
    FitWithProfile result;
    PowerLawFit& fit = result.fit;
    fit.law = found.laws[found.best];
    fit.minimum = place_of(found);
    fit.degrees_of_freedom = data.a.size() - 3;
    fit.a0_high = squares.smallest_a();
    const Judgement judgement{fit.law.sum_of_squares, fit.degrees_of_freedom, data.standard_error.size() > 0};
    if (judgement.possible()) {
        add_interval(squares, found, judgement.threshold(options.confidence), fit);
        result.profile.confidence.resize(static_cast<Index>(found.laws.size()));
        std::transform(found.laws.begin(), found.laws.end(), result.profile.confidence.begin(),
                       [&](const PowerLaw& law) { return judgement.confidence(law.sum_of_squares); });
        if (fit.minimum == PowerLawMinimum::inside) {
            add_standard_errors(data, fit);
        }
    }
    result.profile.laws = found.laws;
    return result;
}

Eigen::VectorXd all_but(const Eigen::VectorXd& values, Index left_out) {
    if (values.size() == 0) {
        return {};
    }
    Eigen::VectorXd rest(values.size() - 1);
    rest << values.head(left_out), values.tail(values.size() - 1 - left_out);
    return rest;
}

void leave_one_out(const PowerLawData& data, const PowerLawOptions& options, const Progress& progress, PowerLawAnalysis& analysis) {
    double farthest_move = -1;
    for (Index k = 0; k < data.a.size(); ++k) {
        const PowerLawData rest{all_but(data.a, k), all_but(data.modulus, k), all_but(data.standard_error, k)};
        analysis.without.push_back(objection_to(rest).empty() ? fit_once(rest, options, progress).fit : PowerLawFit{});
        const double move = std::abs(analysis.without.back().law.a0 - analysis.fit.law.a0);
        if (move > farthest_move) {
            farthest_move = move;
            analysis.decisive = k;
        }
    }
}

}  // namespace

double PowerLaw::c() const {
    return std::exp(log_c);
}

double PowerLaw::modulus(double a) const {
    return std::exp(log_c + beta * std::log(a - a0));
}

PowerLaw fit_power_law_at(const PowerLawData& data, double a0) {
    const std::string objection = objection_to(data);
    require(objection.empty(), objection);
    require_between(a0, -std::numeric_limits<double>::infinity(), data.a.minCoeff(), "the critical value a0");
    return ProfiledSquares(data).best_at(a0);
}

PowerLawAnalysis fit_power_law(const PowerLawData& data, const PowerLawOptions& options, const Progress& progress) {
    const std::string objection = objection_to(data);
    require(objection.empty(), objection);
    require_between(options.confidence, 0, 1, "the confidence of the interval of a0");
    require(options.points >= 10, "the profile of a0 has " + std::to_string(options.points) + " points, but needs at least 10");
    auto [fit, profile] = fit_once(data, options, progress);
    PowerLawAnalysis analysis{.fit = fit, .profile = std::move(profile), .without = {}};
    if (options.leave_one_out) {
        leave_one_out(data, options, progress, analysis);
    }
    return analysis;
}

}  // namespace coagula::mechanics
