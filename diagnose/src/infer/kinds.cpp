// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinds.hpp"

#include "data/knows.hpp"
#include "observables/coordinate.hpp"
#include "smooth.hpp"

#include <coagula/common/log_probability.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

namespace coagula::diagnose {

namespace {

/// Whether gaps or plates differ.
bool plates_differ(const Experiment& experiment) {
    return column_differs(experiment, "gap") || column_differs(experiment, "plate_radius");
}

/// Whether what plates or tool do to a modulus is a factor that does not depend on it.
bool is_proportional(const Mechanism& mechanism, const std::vector<Observation>& observations) {
    std::vector<double> middle;
    for (const MechanismParameter& parameter : mechanism.parameters) {
        middle.push_back(parameter.at(0.7));
    }
    const auto holds = [&](const auto& effect) {
        return std::all_of(observations.begin(), observations.end(), [&](const Observation& row) {
            if (!is<Modulus>(row)) {
                return true;
            }
            const double size = std::abs(row.value);
            const std::complex<double> once = effect.apparent({size, size}, row, middle);
            const std::complex<double> twice = effect.apparent({2 * size, 2 * size}, row, middle);
            return std::abs(twice - 2.0 * once) <= 1e-6 * std::abs(twice);
        });
    };
    const auto* geometry = std::get_if<ChangesGeometry>(&mechanism.effect);
    const auto* tool = std::get_if<ChangesTool>(&mechanism.effect);
    return geometry != nullptr ? holds(*geometry) : tool == nullptr || holds(*tool);
}

/// The kind as far as an experiment tells it. Without other gaps or plates, what these do in time is a change of the sample, and
/// what they do along the strain to a material that may soften in any way is that; along a gap or a radius that is one there is no
/// axis.
Kind told_kind(Kind kind, const Experiment& experiment) {
    const bool flows_alone = any_measurement(experiment, [](const Measurement& table) { return is_flow(table.kind); }) &&
                             !any_measurement(experiment, [](const Measurement& table) { return has_moduli(table.kind); });
    if (kind.axis == Axis::strain && flows_alone) {
        return {kind.link, Axis::shear_rate};  // which a strain amplitude is not
    }
    const bool is_smooth = experiment.material.kind == MaterialKind::smooth;
    if ((kind.axis == Axis::gap && !column_differs(experiment, "gap")) ||
        (kind.axis == Axis::radius && !plates_differ(experiment))) {
        return {kind.link, Axis::level};
    }
    if (kind.link != Link::geometry || plates_differ(experiment)) {
        return kind;
    }
    return kind.axis == Axis::time                  ? Kind{Link::history, Axis::time}
           : kind.axis == Axis::strain && is_smooth ? Kind{Link::material, Axis::strain}
                                                    : kind;
}

/// Whether two axes rise and fall together in all rows, so that a function of one is one of the other. A row that has no place
/// along an axis counts as its lowest.
bool axes_run_together(const std::vector<Observation>& observations, Axis a, Axis b) {
    const Coordinate one = coordinate_along(a);
    const Coordinate other = coordinate_along(b);
    return one != other && one != Coordinate::none && other != Coordinate::none &&
           run_together(rank_along(observations, one), rank_along(observations, other));
}

/// It holds how plates, gap, walls and trap are set in a row, to which a departure may be due. Lengths are hundredths of
/// logarithms, 0 where they are not told.
using Setting = std::tuple<long, long, bool, bool>;

bool are_alike(const Setting& one, const Setting& other) {
    constexpr long nearly = 5;
    const auto [gap, radius, rough, trap] = one;
    const auto [other_gap, other_radius, other_rough, other_trap] = other;
    return std::abs(gap - other_gap) <= nearly && std::abs(radius - other_radius) <= nearly && rough == other_rough &&
           trap == other_trap;
}

std::set<Setting> settings_of(const Experiment& experiment, const std::string& sample, bool of_others) {
    const auto place = [](double length) { return length > 0 ? std::lround(100 * std::log(length)) : 0; };
    std::set<Setting> settings;
    for (const Measurement& table : experiment.measurements) {
        const bool oil = std::isfinite(table.fluid_viscosity);
        for (std::size_t row = 0; !oil && (table.sample == sample) != of_others && row < table.rows(); ++row) {
            settings.emplace(place(cell(table, "gap", row)), place(cell(table, "plate_radius", row)), table.rough_plates,
                             table.solvent_trap);
        }
    }
    return settings;
}

/// Tells whether nothing else was measured as this sample was.
bool is_set_apart(const Experiment& experiment, const std::string& sample) {
    const std::set<Setting> others = settings_of(experiment, sample, true);
    const std::set<Setting> own = settings_of(experiment, sample, false);
    return std::none_of(own.begin(), own.end(), [&](const Setting& setting) {
        return std::any_of(others.begin(), others.end(), [&](const Setting& other) { return are_alike(setting, other); });
    });
}

/// Tells whether a kind, where no cause fits, says no more than another one. An order in time is not told from the time, and a
/// sample that was set apart not from its setting.
bool stands_for(Kind kind, Kind other, const std::vector<Observation>& observations, bool sample_is_set_apart) {
    constexpr std::array settings{Axis::time, Axis::gap, Axis::radius, Axis::level};
    if (kind.axis == Axis::sample) {
        return sample_is_set_apart && std::find(settings.begin(), settings.end(), other.axis) != settings.end();
    }
    return (kind.axis == Axis::time || kind.axis == Axis::age) && axes_run_together(observations, kind.axis, other.axis);
}

/// The kind of a cause as far as an experiment tells it. Where gap and plate are the same in all rows, what depends on the modulus
/// besides follows the frequency.
Kind told_kind(const Mechanism& cause, const Inference& inference) {
    const Experiment& experiment = inference.forward().experiment();
    const std::vector<Observation>& observations = inference.errors().data().observations;
    const Kind told = told_kind(cause.kind, experiment);
    const bool level = told.axis == Axis::level && cause.kind.axis != Axis::level;
    const bool sweeps = rank_along(observations, Coordinate::angular_frequency).maxCoeff() > 0;
    return level && sweeps && !is_proportional(cause, observations) ? Kind{told.link, Axis::frequency} : told;
}

/// The axis with the largest probability, whatever acts along it, and the link that acts along it most probably.
const FollowedKind& most_probable(const std::vector<FollowedKind>& kinds) {
    const auto axis_of = [](const FollowedKind& one) { return one.kind.axis == Axis::age ? Axis::time : one.kind.axis; };
    std::map<Axis, double> axes;
    for (const FollowedKind& one : kinds) {
        axes[axis_of(one)] += one.posterior;
    }
    return *std::max_element(kinds.begin(), kinds.end(), [&](const FollowedKind& a, const FollowedKind& b) {
        return std::pair{axes.at(axis_of(a)), a.posterior} < std::pair{axes.at(axis_of(b)), b.posterior};
    });
}

Eigen::VectorXd prediction_of_base(const Comparison& comparison, const Inference& inference) {
    return inference.fitted(inference.prediction(comparison.all.front().fit.model));
}

/// The sample that departs most, as the mean of its numbers, and by how much.
std::pair<std::string, double> most_apart(const DataSet& data, const Eigen::ArrayXd& share) {
    std::pair<std::string, double> found{"", 0};
    for (Index sample = 0; sample < data.samples(); ++sample) {
        double sum = 0;
        double count = 0;
        for (Index row = 0; row < share.size(); ++row) {
            const bool own = data.sample[static_cast<std::size_t>(row)] == sample && share[row] != 0;
            sum += own ? share[row] : 0;
            count += own ? 1 : 0;
        }
        const double mean = sum / std::max(count, 1.0);
        if (std::abs(mean) >= std::abs(found.second)) {
            found.first = data.sample_names[static_cast<std::size_t>(sample)];
            found.second = mean;
        }
    }
    return found;
}

/// Mean of the share of those numbers that depart at least half as much as the one that departs most.
double mean_of_largest(const Eigen::ArrayXd& share) {
    Index most = 0;
    const double largest = share.abs().maxCoeff(&most);
    double sum = 0;
    double count = 0;
    for (const double one : share) {
        const bool alike = one * share[most] > 0 && std::abs(one) >= 0.5 * largest;
        sum += alike ? one : 0;
        count += alike ? 1 : 0;
    }
    return sum / std::max(count, 1.0);
}

std::pair<double, double> ends_of(const std::vector<Observation>& observations, Coordinate coordinate) {
    std::pair<double, double> ends{unset, unset};
    for (const Observation& one : observations) {
        const double value = coordinate_of(one, coordinate);
        ends = std::isfinite(value) ? std::pair{std::fmin(ends.first, value), std::fmax(ends.second, value)} : ends;
    }
    return ends;
}

/// Mean share at the upper tenth of an axis less that at its lower tenth, of the observable that changes more.
double change_along(const Eigen::VectorXd& rank, const std::vector<Observation>& observations, const Eigen::ArrayXd& share) {
    double found = 0;
    for (const bool loss : {false, true}) {
        Eigen::Array2d sums{0, 0};
        Eigen::Array2d counts{0, 0};
        for (Index row = 0; row < rank.size(); ++row) {
            if (is_loss(observations[static_cast<std::size_t>(row)]) == loss && (rank[row] <= 0.1 || rank[row] >= 0.9)) {
                const Index end = rank[row] <= 0.1 ? 0 : 1;
                sums[end] += share[row];
                counts[end] += 1;
            }
        }
        const Eigen::Array2d means = sums / counts.max(1.0);
        const double change = means[1] - means[0];
        found = std::abs(change) > std::abs(found) ? change : found;
    }
    return found;
}

/// States how large a departure of this form is, and the ends of its axis.
/// @param prediction of the base model, of every number.
Follows followed_by(const FreeForm& form, const DataSet& data, const Eigen::VectorXd& prediction) {
    const Eigen::ArrayXd share = form.departure.array() / complex_moduli(data.observations, prediction).max(1e-300);
    Follows follows{.kind = form.kind, .largest = mean_of_largest(share)};
    if (form.kind.axis == Axis::sample) {
        const auto [sample, change] = most_apart(data, share);
        follows.sample = sample;
        follows.change = change;
        return follows;
    }
    const Coordinate along = coordinate_along(form.kind.axis);
    if (along == Coordinate::none) {
        follows.change = follows.largest;
        return follows;
    }
    std::tie(follows.from, follows.to) = ends_of(data.observations, along);
    follows.change = change_along(rank_along(data.observations, along), data.observations, share);
    return follows;
}

}  // namespace

double weight_alone(const Mechanism* one, const std::vector<Compared>& all) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Compared& each) { return each.fit.hypothesis == Hypothesis{one}; });
    return found == all.end() ? -std::numeric_limits<double>::infinity() : found->log_weight();
}

const Mechanism* leading_member(const Hypothesis& hypothesis, const std::vector<Compared>& all) {
    return *std::max_element(hypothesis.begin(), hypothesis.end(),
                             [&](const Mechanism* a, const Mechanism* b) { return weight_alone(a, all) < weight_alone(b, all); });
}

bool is_separated(Kind kind, const Experiment& experiment) {
    const bool network = experiment.material.kind == MaterialKind::network;
    if (network && kind == Kind{Link::tool, Axis::level}) {
        return has_oil(experiment);
    }
    if (network && kind == Kind{Link::material, Axis::frequency}) {
        return false;
    }
    if (kind == Kind{Link::geometry, Axis::level}) {
        return false;
    }
    if (kind.axis == Axis::strain) {
        return told_kind(kind, experiment).link == kind.link;
    }
    if (kind.axis != Axis::time) {
        return true;
    }
    const Knows knows = knowledge_of(experiment);
    return has_oil(experiment) || has_trap(experiment) || knows.load || knows.shear_before || plates_differ(experiment);
}

bool is_separated(const Mechanism& cause, const Experiment& experiment) {
    return is_separated(cause.kind, experiment) &&
           (cause.told_apart.holds == nullptr || cause.told_apart.holds(knowledge_of(experiment)));
}

std::vector<FollowedKind> kinds_of(const Comparison& comparison, const Inference& inference, bool cause_fits) {
    std::map<Kind, std::vector<double>> weights;
    std::map<Kind, const FreeForm*> forms;
    const double base = comparison.all.front().fit.log_evidence;
    for (const FreeForm& form : comparison.forms) {
        weights[form.kind].push_back(base + form.log_factor);
        forms[form.kind] = &form;
    }
    for (auto one = comparison.all.begin() + 1; one != comparison.all.end(); ++one) {
        const Mechanism& cause = *leading_member(one->fit.hypothesis, comparison.all);
        weights[told_kind(cause, inference)].push_back(one->log_weight());
    }
    std::vector<std::pair<double, FollowedKind>> kinds;  // each behind its weight
    for (const auto& [kind, own] : weights) {
        const auto form = forms.find(kind);
        kinds.emplace_back(log_sum(own),
                           FollowedKind{.kind = kind, .log_factor = form == forms.end() ? unset : form->second->log_factor});
    }
    std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    const DataSet& data = inference.errors().data();
    const auto of_sample = forms.find({Link::errors, Axis::sample});
    const bool apart = !cause_fits && of_sample != forms.end() &&
                       is_set_apart(inference.forward().experiment(),
                                    followed_by(*of_sample->second, data, prediction_of_base(comparison, inference)).sample);
    std::vector<double> logarithms;
    for (const auto& [weight, one] : kinds) {
        const auto as_heavy = std::find_if(kinds.begin(), kinds.end(), [&, kind = one.kind](const auto& heavier) {
            return heavier.second.kind == kind || (!cause_fits && stands_for(heavier.second.kind, kind, data.observations, apart));
        });
        logarithms.push_back(as_heavy->first);
    }
    const std::vector<double> posterior = probabilities_of(std::move(logarithms));
    std::vector<FollowedKind> all;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        all.push_back(kinds[k].second);
        all.back().posterior = posterior[k];
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const FollowedKind& a, const FollowedKind& b) { return a.posterior > b.posterior; });
    return all;
}

Follows follows_of(const std::vector<FollowedKind>& kinds, const Comparison& comparison, const Inference& inference) {
    const FollowedKind& first = most_probable(kinds);
    const Kind shown = first.kind.axis == Axis::age ? Kind{Link::history, Axis::time} : first.kind;
    const auto form =
        std::find_if(comparison.forms.begin(), comparison.forms.end(), [&](const FreeForm& one) { return one.kind == shown; });
    Follows follows{.kind = first.kind};
    if (form != comparison.forms.end()) {
        follows = followed_by(*form, inference.errors().data(), prediction_of_base(comparison, inference));
    }
    follows.kind = first.kind;
    follows.posterior = first.posterior;
    return follows;
}

}  // namespace coagula::diagnose
