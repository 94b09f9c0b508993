// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/pair_potential.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

constexpr int scan_points_per_decade = 400;
constexpr int bisections = 200;

/// The zero of `function` between two points where its signs differ.
template <class Function>
double bisect(double low, double high, Function&& function) {
    const bool rising = function(high) > 0;
    for (int turn = 0; turn < bisections && low < high; ++turn) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) {
            break;
        }
        ((function(middle) > 0) == rising ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

void check(const std::vector<PairLaw>& laws, double stiffness) {
    require(!laws.empty(), "the pair potential has no laws, but it needs at least one");
    require(stiffness > 0 && std::isfinite(stiffness),
            "the contact stiffness is " + to_text(stiffness) +
                " N/m, but it must be positive: without contact repulsion the particles would fall into each other");
}

}  // namespace

PairPotential::PairPotential(std::vector<PairLaw> laws, const ElasticContact& contact) : laws_(std::move(laws)), contact_(contact) {
    check(laws_, contact.stiffness);
    require_positive(contact.equilibrium_gap, "the equilibrium gap of the contact", "m");
    cut_gap_ = solve_cut_gap();
    cut_off();
}

PairPotential::PairPotential(std::vector<PairLaw> laws, double stiffness, double cut_gap, double farthest)
    : laws_(std::move(laws)), contact_{.stiffness = stiffness}, cut_gap_(cut_gap) {
    check(laws_, stiffness);
    require(std::isfinite(cut_gap) && cut_gap < farthest,
            "the cut-off gap of the contact is " + to_text(cut_gap) + " m, but it must be less than " + to_text(farthest) + " m");
    cut_off();
    contact_.equilibrium_gap = solve_rest(farthest);
}

/// Takes over from the laws at the cut-off gap.
void PairPotential::cut_off() {
    cut_force_ = sum_force(cut_gap_);
    cut_energy_ = sum_energy(cut_gap_);
    require(std::isfinite(cut_gap_) && std::isfinite(cut_force_) && std::isfinite(cut_energy_),
            "the pair potential is beyond the range of numbers at the contact: at a gap of " + to_text(cut_gap_) +
                " m its force is " + to_text(cut_force_) + " N and its energy " + to_text(cut_energy_) + " J");
}

double PairPotential::sum_energy(double gap) const {
    double sum = 0;
    for (const PairLaw& law : laws_) {
        sum += std::visit([gap](const auto& one) { return one.energy(gap); }, law);
    }
    return sum;
}

double PairPotential::sum_force(double gap) const {
    double sum = 0;
    for (const PairLaw& law : laws_) {
        sum += std::visit([gap](const auto& one) { return one.force(gap); }, law);
    }
    return sum;
}

double PairPotential::solve_cut_gap() const {
    const double rest = contact_.equilibrium_gap;
    if (sum_force(rest) >= 0) {
        return rest;
    }
    const auto at_rest = [this, rest](double cut) { return sum_force(cut) + contact_.stiffness * (cut - rest); };
    // The nearest cut-off, where the spring has caught up with the attraction; it must lie inside the attractive range, so that no
    // barrier is cut away.
    const double ratio = std::pow(10.0, 1.0 / scan_points_per_decade);
    double low = rest;
    for (double cut = rest * ratio; cut < 100 * rest; low = cut, cut *= ratio) {
        if (sum_force(cut) >= 0) {
            break;
        }
        if (at_rest(cut) >= 0) {
            return bisect(low, cut, at_rest);
        }
    }
    throw std::invalid_argument("the contact stiffness is " + to_text(contact_.stiffness) +
                                " N/m, too soft to hold the attraction at an equilibrium gap of " + to_text(rest) +
                                " m: take a stiffer contact or a larger gap");
}

double PairPotential::solve_rest(double farthest) const {
    constexpr int steps = 4000;
    require(cut_force_ > 0,
            "the laws of the pair potential attract at the cut-off gap of " + to_text(cut_gap_) +
                " m, but they must repel there: without contact repulsion the particles would fall into each other");
    const double width = (farthest - cut_gap_) / steps;
    for (int step = 0; step < steps; ++step) {
        const double low = cut_gap_ + step * width;
        if (sum_force(low + width) <= 0) {
            const double rest = bisect(low, low + width, [this](double at) { return sum_force(at); });
            return require_positive(rest, "the gap at which two particles rest", "m");
        }
    }
    throw std::invalid_argument("the laws of the pair potential repel at all gaps up to " + to_text(farthest) +
                                " m: there is no gap at which two particles rest");
}

double PairPotential::energy(double gap) const {
    if (gap >= cut_gap_) {
        return sum_energy(gap);
    }
    const double depth = cut_gap_ - gap;
    return cut_energy_ + cut_force_ * depth + 0.5 * contact_.stiffness * depth * depth;
}

double PairPotential::force(double gap) const {
    return gap >= cut_gap_ ? sum_force(gap) : cut_force_ + contact_.stiffness * (cut_gap_ - gap);
}

std::vector<Extreme> PairPotential::extremes(double farthest, bool maxima) const {
    std::vector<Extreme> found;
    const double ratio = std::pow(10.0, 1.0 / scan_points_per_decade);
    // Between the cut-off and the bottom of a well of the laws themselves the force only repels.
    double low = std::max(cut_gap_, contact_.equilibrium_gap);
    for (double gap = low * ratio; low < farthest; low = gap, gap *= ratio) {
        // At a maximum the force turns from attraction to repulsion.
        const bool turns = maxima ? force(low) < 0 && force(gap) >= 0 : force(low) > 0 && force(gap) <= 0;
        if (turns) {
            const double where = bisect(low, gap, [this](double at) { return force(at); });
            found.push_back({where, energy(where)});
        }
    }
    return found;
}

std::optional<Extreme> PairPotential::barrier(double farthest) const {
    const std::vector<Extreme> maxima = extremes(farthest, true);
    const auto highest =
        std::max_element(maxima.begin(), maxima.end(), [](const Extreme& a, const Extreme& b) { return a.energy < b.energy; });
    return highest != maxima.end() ? std::optional(*highest) : std::nullopt;
}

std::optional<Extreme> PairPotential::secondary_minimum(double farthest) const {
    const std::vector<Extreme> maxima = extremes(farthest, true);
    std::vector<Extreme> minima = extremes(farthest, false);
    if (maxima.empty()) {
        return std::nullopt;
    }
    std::erase_if(minima, [&](const Extreme& minimum) { return minimum.gap < maxima.front().gap || minimum.energy >= 0; });
    const auto lowest =
        std::min_element(minima.begin(), minima.end(), [](const Extreme& a, const Extreme& b) { return a.energy < b.energy; });
    return lowest != minima.end() ? std::optional(*lowest) : std::nullopt;
}

double PairPotential::barrier_height(double farthest) const {
    const std::optional<Extreme> top = barrier(farthest);
    const std::optional<Extreme> bottom = secondary_minimum(farthest);
    return top ? std::max(0.0, top->energy - (bottom ? bottom->energy : 0.0)) : 0.0;
}

}  // namespace coagula::generators
