// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinds.hpp"

#include "data/knows.hpp"

#include <coagula/common/log_probability.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <variant>

namespace coagula::diagnose {

namespace {

template <class OfTable>
bool any_table(const Experiment& experiment, const OfTable& has) {
    return std::any_of(experiment.measurements.begin(), experiment.measurements.end(), has);
}

bool column_differs(const Experiment& experiment, const char* column) {
    return differs(experiment, [&](const Measurement& table, std::size_t row) { return cell(table, column, row); });
}

/// Whether gaps or plates differ.
bool plates_differ(const Experiment& experiment) {
    return column_differs(experiment, "gap") || column_differs(experiment, "plate_radius");
}

bool has_oil(const Experiment& experiment) {
    return any_table(experiment, [](const Measurement& table) { return std::isfinite(table.fluid_viscosity); });
}

/// The kind as far as an experiment tells it. Without other gaps or plates, what these do in time is a change of the sample, and
/// what they do along the strain to a material that may soften in any way is that; along a gap or a radius that is one there is no
/// axis.
Kind told_kind(Kind kind, const Experiment& experiment) {
    const bool flows_alone = any_table(experiment, [](const Measurement& table) { return is_flow(table.kind); }) &&
                             !any_table(experiment, [](const Measurement& table) { return has_moduli(table.kind); });
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
    const bool trap = any_table(experiment, [](const Measurement& table) { return table.solvent_trap; });
    return has_oil(experiment) || trap || knows.load || knows.shear_before || plates_differ(experiment);
}

bool is_separated(const Mechanism& cause, const Experiment& experiment) {
    const auto* scales = std::get_if<ScalesMaterial>(&cause.effect);
    const bool in_oil = scales != nullptr && scales->in_oil && experiment.material.kind != MaterialKind::newtonian;
    return in_oil ? has_oil(experiment) : is_separated(cause.kind, experiment);
}

std::vector<FollowedKind> kinds_of(const Comparison& comparison, const Experiment& experiment) {
    std::map<Kind, std::vector<double>> weights;
    std::map<Kind, const FreeForm*> forms;
    const double base = comparison.all.front().fit.log_evidence;
    for (const FreeForm& form : comparison.forms) {
        weights[form.kind].push_back(base + form.log_factor);
        forms[form.kind] = &form;
    }
    for (auto one = comparison.all.begin() + 1; one != comparison.all.end(); ++one) {
        const Kind kind = leading_member(one->fit.hypothesis, comparison.all)->kind;
        weights[told_kind(kind, experiment)].push_back(one->log_weight());
    }
    std::vector<double> logarithms;
    std::vector<FollowedKind> kinds;
    for (const auto& [kind, own] : weights) {
        logarithms.push_back(log_sum(own));
        const auto form = forms.find(kind);
        kinds.push_back({.kind = kind, .log_factor = form == forms.end() ? unset : form->second->log_factor});
    }
    const std::vector<double> posterior = probabilities_of(std::move(logarithms));
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        kinds[k].posterior = posterior[k];
    }
    std::stable_sort(kinds.begin(), kinds.end(),
                     [](const FollowedKind& a, const FollowedKind& b) { return a.posterior > b.posterior; });
    return kinds;
}

Follows follows_of(const std::vector<FollowedKind>& kinds, const Comparison& comparison, const Inference& inference) {
    const FollowedKind& first = kinds.front();
    const Kind shown = first.kind.axis == Axis::age ? Kind{Link::history, Axis::time} : first.kind;
    const auto form =
        std::find_if(comparison.forms.begin(), comparison.forms.end(), [&](const FreeForm& one) { return one.kind == shown; });
    Follows follows{.kind = first.kind};
    if (form != comparison.forms.end()) {
        const Prediction base = inference.prediction(comparison.all.front().fit.model);
        follows = followed_by(*form, inference.errors().data(), inference.fitted(base));
    }
    follows.kind = first.kind;
    follows.posterior = first.posterior;
    return follows;
}

}  // namespace coagula::diagnose
