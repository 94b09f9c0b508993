// SPDX-License-Identifier: GPL-3.0-or-later
#include "rate_steps.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace coagula::experiment {

namespace {

using diagnose::Column;
using diagnose::Measurement;

constexpr double stays_within = 0.05;        // of the rate
constexpr double same_within = 0.2;          // of the rate; what differs by less is on the way to it
constexpr double at_rest_within = 1e-3;      // of the largest rate
constexpr double drifts_less = 1.0 / 3;      // of what the rate may differ by; a ramp drifts by more
constexpr std::size_t shortest_plateau = 3;  // rows
constexpr std::size_t steady_rows = 5;       // at most, at the end of a plateau, whose stress counts as steady

/// The mean of the numbers in these rows; not a number where there are none.
double mean(const std::vector<double>& values, std::size_t first, std::size_t last) {
    double sum = 0;
    double count = 0;
    for (std::size_t row = first; row <= last; ++row) {
        if (std::isfinite(values[row])) {
            sum += values[row];
            ++count;
        }
    }
    return sum / count;
}

/// Rates of which the next plateau is found from a row on.
class Rates {
public:
    explicit Rates(const std::vector<double>& values) : values_(values) {
        for (const double value : values) {
            largest_ = std::max(largest_, std::abs(value));
        }
    }

    /// How far a rate may be from one that stays.
    double tolerance(double rate) const { return std::max(stays_within * std::abs(rate), at_rest_within * largest_); }

    /// The last row of the plateau that begins with this one; nothing where none does.
    std::optional<std::size_t> plateau_from(std::size_t first) const {
        std::size_t last = first;
        for (double sum = values_[first]; last + 1 < values_.size(); sum += values_[++last]) {
            const double rate = sum / static_cast<double>(last + 1 - first);
            if (!(std::abs(values_[last + 1] - rate) <= tolerance(rate))) {
                break;
            }
        }
        const std::size_t rows = last + 1 - first;
        if (first == 0 && rows == 2) {  // of the rate before, which many exports hardly show
            return last;
        }
        if (rows < shortest_plateau) {
            return std::nullopt;
        }
        const double drift = mean(values_, first + rows / 2, last) - mean(values_, first, first + rows / 2 - 1);
        return std::abs(drift) <= drifts_less * tolerance(mean(values_, first, last)) ? std::optional(last) : std::nullopt;
    }

private:
    const std::vector<double>& values_;
    double largest_ = 0;
};

/// The stress [Pa], if need be of viscosity and rate.
std::vector<double> stress_of(const Measurement& table, const Column& rate) {
    if (const Column* stress = diagnose::find_column(table, "stress")) {
        return stress->values;
    }
    std::vector<double> stress;
    if (const Column* viscosity = diagnose::find_column(table, "viscosity")) {
        std::transform(viscosity->values.begin(), viscosity->values.end(), rate.values.begin(), std::back_inserter(stress),
                       std::multiplies<>());
    }
    return stress;
}

/// Rows in which the rate stays, without their steps. A rate that hardly differs from the one before was on the way to it.
std::vector<RatePlateau> plateaus_of(const std::vector<double>& rate) {
    const Rates rates(rate);
    std::vector<RatePlateau> plateaus;
    for (std::size_t row = 0; row < rate.size(); ++row) {
        const std::optional<std::size_t> last = rates.plateau_from(row);
        if (!last) {
            continue;
        }
        const double before = plateaus.empty() ? 0 : mean(rate, plateaus.back().first, plateaus.back().last);
        const double apart = std::abs(mean(rate, row, *last) - before);
        if (plateaus.empty() || apart > same_within / stays_within * rates.tolerance(before)) {
            plateaus.push_back({row, *last, std::nullopt});
        } else if (*last - row > plateaus.back().last - plateaus.back().first) {
            plateaus.back() = {row, *last, std::nullopt};
        }
        row = *last;
    }
    return plateaus;
}

/// The step between two plateaus; nothing where no number says the stress before.
std::optional<RateStep> step_between(const RatePlateau& before, const RatePlateau& after, const std::vector<double>& rate,
                                     const std::vector<double>& stress, const std::vector<double>& time) {
    const std::size_t steady = std::min(steady_rows, before.last - before.first);
    RateStep step{mean(rate, before.first, before.last), mean(rate, after.first, after.last),
                  mean(stress, before.last + 1 - steady, before.last), 0};
    if (std::abs(step.rate_before) <= Rates(rate).tolerance(0)) {
        step.rate_before = step.stress_before = 0;
    }
    if (time[after.first] > time[before.last]) {  // the clock goes on
        step.time_zero = time[before.last];
    }
    return std::isfinite(step.stress_before) ? std::optional(step) : std::nullopt;
}

}  // namespace

std::vector<RatePlateau> rate_plateaus(const Measurement& table) {
    const Column* rate = diagnose::find_column(table, "shear_rate");
    const Column* time = diagnose::find_column(table, "time");
    const std::vector<double> stress = rate != nullptr ? stress_of(table, *rate) : std::vector<double>{};
    if (rate == nullptr || time == nullptr || stress.empty()) {
        return {};
    }
    std::vector<RatePlateau> plateaus = plateaus_of(rate->values);
    std::size_t covered = 0;
    for (std::size_t k = 0; k < plateaus.size(); ++k) {
        covered += plateaus[k].last + 1 - plateaus[k].first;
        if (k > 0) {
            plateaus[k].step = step_between(plateaus[k - 1], plateaus[k], rate->values, stress, time->values);
        }
    }
    return 2 * covered >= table.rows() && plateaus.size() > 1 ? plateaus : std::vector<RatePlateau>{};
}

Measurement start_up_of(Measurement rows, const RateStep& step) {
    rows.kind = diagnose::MeasurementKind::start_up;
    rows.rate_before = step.rate_before;
    rows.stress_before = step.stress_before;
    for (Column& column : rows.columns) {
        if (column.name == "time") {
            std::for_each(column.values.begin(), column.values.end(), [&](double& value) { value -= step.time_zero; });
        }
    }
    return rows;
}

}  // namespace coagula::experiment
