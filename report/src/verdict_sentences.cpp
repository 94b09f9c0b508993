// SPDX-License-Identifier: GPL-3.0-or-later
// The verdict in words: whether the base model fails and which cause is named, then what is certain without a cause, what is left
// over and what to measure next.
#include "verdict_sentences.hpp"

#include "finding_sentences.hpp"
#include "html.hpp"

#include <coagula/report/diagnosis_page.hpp>
#include <coagula/report/diagnosis_results.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace coagula::report {

namespace {

using diagnose::Axis;
using diagnose::Cause;
using diagnose::Diagnosis;
using diagnose::Link;
using diagnose::Verdict;

std::string print_number(double value) {
    return printed(value);
}

std::string gained(const diagnose::Gain& gain) {
    return gain.held_out == 0 ? std::string{}
                              : " On rows held out from the fit its error is " + percent(gain.rmse_extended) + " instead of " +
                                    percent(gain.rmse_base) + "; the log predictive density changes by " +
                                    change_of_density(gain, print_number) + ".";
}

struct AxisWords {
    Axis axis;
    const char* words;
    const char* unit;
};

constexpr std::array axis_words{AxisWords{Axis::time, "the time since the sample was loaded", "s"},
                                AxisWords{Axis::age, "the time since the last shear that destroyed the structure", "s"},
                                AxisWords{Axis::strain, "the strain amplitude", "1"},
                                AxisWords{Axis::frequency, "the frequency", "rad/s"},
                                AxisWords{Axis::shear_rate, "the shear rate", "1/s"},
                                AxisWords{Axis::gap, "the gap", "m"},
                                AxisWords{Axis::radius, "the radius of the plates", "m"},
                                AxisWords{Axis::normal_force, "the normal force", "N"},
                                AxisWords{Axis::volume_fraction, "the volume fraction", "1"},
                                AxisWords{Axis::coordination, "the coordination", "1"},
                                AxisWords{Axis::heterogeneity, "the heterogeneity of the structures", "1"},
                                AxisWords{Axis::distance, "the distance between particles in diameters", "1"},
                                AxisWords{Axis::pore_radius, "the radius of the pores", "m"},
                                AxisWords{Axis::sample, "the sample", "1"},
                                AxisWords{Axis::level, "no single axis that was varied", "1"}};

const AxisWords& words_of(Axis axis) {
    return *std::find_if(axis_words.begin(), axis_words.end(), [axis](const AxisWords& one) { return one.axis == axis; });
}

/// Tells whether samples differ between plates where an oil does not.
bool is_of_filling(const diagnose::Kind& kind) {
    return kind.link == Link::history && (kind.axis == Axis::gap || kind.axis == Axis::radius);
}

/// What a link does, to go on after "it acts like".
const char* acts_like(const diagnose::Kind& kind) {
    if (is_of_filling(kind)) {
        return "samples that differ or were filled otherwise, for the oil does not follow it";
    }
    switch (kind.link) {
        case Link::structure:
            return "another structure";
        case Link::material:
            return "a property of the material";
        case Link::history:
            return "a change of the sample with its history";
        case Link::geometry:
            return "what plates do to the strain or to the rim";
        case Link::tool:
            return "a tool that adds a torque, gives way or turns the phase";
        default:
            return "an error of measurement or of one sample";
    }
}

/// What a condition of a name says of the best cause where it does not hold.
const std::array<std::pair<const char*, const char*>, 11> failed_conditions{
    {{"beats-free-forms", "a smooth departure without any cause explains the data as well"},
     {"beats-other-axes", "a departure along another axis explains the data as well"},
     {"beats-readings", "a torque or an angle that the instrument does not read in proportion explains the data as well"},
     {"every-cause-counts", "one of its two causes explains the data about as well alone"},
     {"inside-range", "a value lies at the end of its physical range"},
     {"narrower-than-prior", "the data leave its value as open as it was"},
     {"little-left", "it leaves over a part of the misfit"},
     {"predicts-held-out", "it does not predict rows that were held out better than the base model"},
     {"predicts-like-smooth", "a smooth correction predicts rows that were held out better"},
     {"without-any-row", "it rests on a single row"},
     {"separated", "nothing that was measured tells it from look-alikes outside the catalogue"}}};

/// Why the best cause has no name.
std::string reasons(const Diagnosis& found) {
    std::vector<std::string> missing;
    for (const diagnose::Condition& condition : found.conditions) {
        const auto known = std::find_if(failed_conditions.begin(), failed_conditions.end(),
                                        [&](const auto& one) { return condition.name == one.first; });
        if (!condition.holds && known != failed_conditions.end()) {
            missing.emplace_back(known->second);
        }
    }
    return joined(missing, " and ");
}

/// What data tell that leave several causes: goes on after "The base model fails".
std::string tied_sentence(const Diagnosis& found) {
    const std::string unknown = "hese data cannot tell whether ";
    if (found.credible_set.size() == 2 && found.credible_set.back().unknown) {
        const std::string why = reasons(found);
        return "; " + name_of(found.credible_set.front()) + " explains the data" + (why.empty() ? "" : ", but " + why) +
               ". The cause may be another one, which the catalogue does not have.";
    }
    if (found.certain.is_base()) {
        return "; t" + unknown + "the cause is " + joined(names_of(found.credible_set)) + ".";
    }
    std::vector<diagnose::CauseSet> rest;
    for (const diagnose::CauseSet& member : found.credible_set) {
        rest.push_back(member.without(found.certain));
    }
    const bool alone = std::erase(rest, diagnose::CauseSet()) > 0;
    const std::string others = joined(names_of(rest));
    const std::string certain = joined(names_in(found.certain));
    return alone ? ", and " + certain + " is a cause. T" + unknown + others + " is another."
                 : ", and " + certain + " is one cause. There is another; t" + unknown + "that is " + others + ".";
}

std::string kind_only_sentence(const Diagnosis& found) {
    const Cause* best = best_cause(found);
    const std::string why = reasons(found);
    return "; no cause is certain. The most probable is " + (best == nullptr ? "none" : best->name()) +
           (why.empty() ? "." : ", but " + why + ".");
}

/// The causes of the kind that the data follow, the most probable ones first.
std::vector<std::string> causes_of_kind(const Diagnosis& found) {
    constexpr std::size_t most = 4;
    std::vector<std::string> names;
    for (const Cause& cause : found.causes) {
        const std::vector<std::size_t>& members = cause.set.members;
        const bool single = members.size() == 1 && diagnose::catalogue()[members.front()].kind == found.follows.kind;
        if (single && names.size() < most) {
            names.push_back(cause.name());
        }
    }
    return names;
}

/// What to measure where no candidate measurement is likely to decide: a way to take this link and axis apart from others.
const char* advice(const diagnose::Kind& kind, bool of_oil) {
    if (of_oil && kind.link != Link::history && kind.link != Link::errors) {
        return "Measure another oil of known viscosity, at two more gaps and between plates of another radius: what the instrument "
               "does is the same there.";
    }
    if (is_of_filling(kind)) {
        return "Fill every gap and plate with several samples of one batch, in no order, and wait equally long: what belongs to "
               "batch or filling does not come back.";
    }
    switch (kind.link) {
        case Link::history:
            return "Measure one point again and again on a fresh sample, under a solvent trap and between plates of another "
                   "radius: what the clock does alone shows there, and what dries or creeps depends on the plates.";
        case Link::geometry:
            return "Measure at two more gaps, with rough plates and with an oil of known viscosity: the plates act on the "
                   "oil, too.";
        case Link::tool:
            return "Measure an oil of known viscosity, the empty tool, and the sample between plates of another radius: what "
                   "the tool adds does not change with the sample.";
        case Link::structure:
            return "Measure a second sample of another volume fraction, or image the structure.";
        case Link::errors:
            return "Repeat the measurement on two more fresh samples: what belongs to one sample does not come back.";
        default:
            break;
    }
    switch (kind.axis) {
        case Axis::frequency:
            return "Measure an oil of known viscosity, and repeat the sweep on a fresh sample in the opposite order: the oil "
                   "shows an error of the phase or of the tool, too.";
        case Axis::strain:
            return "Sweep the strain down again, at another frequency and at another gap: the material shows the same there, "
                   "and a slip or a torque does not.";
        default:
            return "Repeat the measurement on a fresh sample, in the opposite order and between plates of another radius: the"
                   " material shows the same there.";
    }
}

/// How large what the data follow is: from end to end of the axis, or where it is largest.
std::string size_text(const diagnose::Follows& follows, const std::string& unit) {
    const bool has_ends = std::isfinite(follows.from);
    const std::string ends = has_ends ? " from " + printed(follows.from, unit) + " to " + printed(follows.to, unit) : "";
    if (std::isfinite(follows.change) && std::abs(follows.change) >= 0.5 * std::abs(follows.largest)) {
        return ", by " + signed_percent(follows.change) + " of |G*|" + ends;
    }
    return std::isfinite(follows.largest) ? ", by up to " + signed_percent(follows.largest) + " of |G*|" + ends : "";
}

}  // namespace

std::string what_separates(const Diagnosis& found) {
    const Cause* best = best_cause(found);
    if (best == nullptr || best->set.members.size() != 1) {
        return "";  // of a pair one member may be told apart
    }
    std::vector<std::string> missing;
    for (const diagnose::Condition& condition : found.conditions) {
        if (!condition.holds) {
            missing.push_back(condition.name);
        }
    }
    return missing == std::vector<std::string>{"separated"} ? diagnose::catalogue()[best->set.members.front()].told_apart.by : "";
}

std::string chance_text(const Diagnosis& found) {
    return (is_least_p(found) ? "p ≤ " : "p = ") + print_number(found.p_value);
}

std::string joined(const std::vector<std::string>& names, const std::string& last) {
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k) {
        text += (k == 0 ? "" : k + 1 == names.size() ? last : ", ") + names[k];
    }
    return text;
}

std::string axis_in_words(const diagnose::Follows& follows) {
    return words_of(follows.kind.axis).words + (follows.sample.empty() ? "" : " '" + follows.sample + "'");
}

std::string follows_sentence(const Diagnosis& found) {
    constexpr double sure = 0.9;
    constexpr double likely = 0.5;
    const diagnose::Follows& follows = found.follows;
    const std::string chance = " (probability " + probability_text(follows.posterior) + ")";
    std::string text = follows.posterior >= sure     ? "What is certain: the deviation follows "
                       : follows.posterior >= likely ? "The deviation probably follows "
                                                     : "It is open what the deviation follows. The most probable is ";
    text += axis_in_words(follows) + size_text(follows, words_of(follows.kind.axis).unit);
    text += follows.posterior >= sure ? "" : chance;
    text += std::string(". It acts like ") + acts_like(follows.kind) +
            (follows.link_is_told ? "." : ", but nothing that was measured tells that from what else follows the same.");
    const std::vector<std::string> causes = causes_of_kind(found);
    return text + (causes.empty() ? " The catalogue has no cause of that kind." : " Causes of that kind: " + joined(causes) + ".");
}

std::string verdict_sentence(const Diagnosis& found) {
    const std::string chance = " (" + chance_text(found) + ")";
    if (found.verdict == Verdict::no_discrepancy) {
        return "The base model explains the data: these " + std::to_string(found.observations) +
               " moduli show no deviation from it" + chance + ".";
    }
    const std::string fails = "The base model fails" + chance;
    if (found.verdict == Verdict::none_of_catalogue) {
        const Cause* best = best_cause(found);
        if (best != &found.causes.front()) {
            return fails + ", and no cause of the catalogue explains the deviation.";
        }
        const std::string why = reasons(found);
        return fails + ". No cause of the catalogue is enough: the best is " + best->name() +
               (why.empty() ? "." : ", but " + why + ".");
    }
    if (found.verdict == Verdict::tied) {
        return fails + tied_sentence(found);
    }
    if (found.verdict == Verdict::kind_only) {
        return fails + kind_only_sentence(found);
    }
    const Cause& cause = found.causes.front();
    return fails + "; the cause is " + cause.name() + ": " + cause.words + " (probability " + probability_text(cause.posterior) +
           ")." + gained(found.gain);
}

std::vector<std::string> verdict_sentences(const Diagnosis& found) {
    constexpr double likely = 0.5;
    std::vector<std::string> sentences{verdict_sentence(found)};
    if (found.detected && found.verdict != Verdict::named) {
        sentences.push_back(follows_sentence(found));
    }
    if (const Cause* best = best_cause(found); best != nullptr && found.remainder.detected) {
        sentences.push_back("The best cause, " + best->name() + ", leaves " +
                            (found.remainder.most ? "most of the misfit: " : "a deviation: ") + sentence_on(found.remainder) + ".");
    }
    if (!found.proposals.empty() && found.proposals.front().resolution >= likely) {
        sentences.push_back("To decide, measure " + words_for(found.proposals.front()) + ".");
    } else if (found.detected && found.verdict != Verdict::named) {
        const auto& of_base = found.base.parameters;
        const bool of_oil = !of_base.empty() && of_base.front().name == "viscosity";
        const std::string by = what_separates(found);
        sentences.push_back(by.empty() ? advice(found.follows.kind, of_oil) : "To name it, measure " + by + ".");
    }
    return sentences;
}

bool leaves_open(const diagnose::EstimatedParameter& parameter) {
    return parameter.low > 0 && parameter.high >= 10 * parameter.low;
}

}  // namespace coagula::report
