// SPDX-License-Identifier: GPL-3.0-or-later
#include "strain_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

constexpr int easy_solutions = 25;         // with a factor, in a step after which a longer one is tried
constexpr double strength_reached = 1e-9;  // load ratios nearer to 1 than this are at the strength
constexpr double overshoot = 0.01;         // beyond the strain at which a bond is expected to break
constexpr double worth_shortening = 0.9;   // of a step
constexpr double energy_rounding = 1e-12;
constexpr double resolution = 5e-3;  // of a fall to another branch that Newton's method did not notice, in smallest steps
constexpr int most_settlements = 50;
constexpr int most_event_iterations = 60;

}  // namespace

StrainPath::StrainPath(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                       const QuasistaticOptions& options, double largest_strain, const Progress& progress)
    : options_(options),
      largest_strain_(largest_strain),
      progress_(progress),
      told_([this](std::string_view /*stage*/, double /*fraction*/, std::string_view /*remark*/) {
          tell();
          return true;
      }),
      network_(packing, bonds, model, options),
      solver_(options.tolerance, effort_),
      step_(std::numeric_limits<double>::infinity()) {
    tell();
    settle();
    point_.stored = network_.energy(network_.memories());
    update_point();
    break_overloaded([](const StrainPoint&) {});
}

void StrainPath::give_up(const std::string& what) const {
    throw NoEquilibrium("no equilibrium was found " + what + " at the strain " + to_text(network_.strain()) +
                        ": the rms force left on a particle is " + to_text(solver_.last_residual()) +
                        " times the contact stiffness and the mean radius");
}

void StrainPath::tell() const {
    progress_.update("shearing", std::min(1.0, (static_cast<double>(reached_) + part_) / static_cast<double>(targets_)), remark_);
}

void StrainPath::update_point() {
    point_.strain = network_.strain();
    point_.stress = network_.stress(rest_);
    peak_stress_ = std::max(peak_stress_, std::abs(point_.stress(options_.orientation.normal, options_.orientation.direction)));
    point_.bonds = network_.intact_bonds();
    point_.contacts = network_.touching_contacts();
}

/// Equilibrium at constant strain from the committed state, whatever was changed in it. Returns what friction dissipated. Where the
/// way is long it goes part by part: neighbours are looked for, and turned contacts begin anew, from where it came to.
double StrainPath::settle() {
    const double start = network_.energy(network_.memories());
    const Motion still = Motion::Zero(6 * network_.particles());
    double energy = start;
    double dissipated = 0;
    for (int attempt = 0; attempt < most_settlements; ++attempt) {
        tell();
        bool found = solver_.find(network_, 0.0, still, rest_) && network_.reach_used(0.0, rest_.motion) <= 1 &&
                     network_.energy(rest_.memory) + rest_.dissipated <= start + 1e-9 * std::abs(start);
        found = found || solver_.minimise(network_, 0.0, still, rest_, told_);
        const bool came_far = network_.reach_used(0.0, rest_.motion) > 1;
        const double left = network_.energy(rest_.memory) + rest_.dissipated;
        const bool came_down = left < energy - energy_rounding * start;
        if (!found && !came_far && !came_down) {
            give_up("at constant strain");
        }
        energy = left - rest_.dissipated;
        dissipated += rest_.dissipated;
        const bool touched = network_.commit(rest_);
        network_.evaluate(0.0, still, rest_);
        if (found && !touched && !came_far) {
            return dissipated;
        }
    }
    give_up("at constant strain");
}

Motion StrainPath::guess(double increment) {
    if (velocity_.size() == 0) {
        velocity_ = solver_.predict(network_, rest_);
    }
    return increment * velocity_;
}

void StrainPath::remember(const Trial& trial) {
    if (trial.strain_increment != 0) {
        velocity_ = trial.motion / trial.strain_increment;
    }
}

void StrainPath::commit(Trial& trial, const Record& record) {
    const StrainPoint before = point_;
    if (!is_smooth(trial) && defect(trial) > 0) {  // no smaller step was left: a fall on the way
        point_.released += defect(trial);
        ++effort_.jumps;
    }
    remember(trial);
    const double stored = network_.energy(trial.memory);
    const bool touched = network_.commit(trial);
    point_.stored = stored;
    point_.dissipated += trial.dissipated;
    ++effort_.steps;
    if (network_.contacts().size() == trial.memory.size() && !touched) {
        rest_ = std::move(trial);
        rest_.strain_increment = 0;
        rest_.motion.setZero();
    } else {
        network_.evaluate(0.0, Motion::Zero(6 * network_.particles()), rest_);
    }
    update_point();
    point_.work += work_between(before, point_);
    if (touched) {
        const double dissipated = settle();
        const double now = network_.energy(network_.memories());
        point_.released += point_.stored - now - dissipated;
        point_.dissipated += dissipated;
        point_.stored = now;
        update_point();
    }
    record(point_);
}

double StrainPath::work_between(const StrainPoint& from, const StrainPoint& to) const {
    const auto [normal, direction] = options_.orientation;
    return 0.5 * network_.volume() * (from.stress(normal, direction) + to.stress(normal, direction)) * (to.strain - from.strain);
}

/// Work less what is stored and dissipated.
double StrainPath::defect(const Trial& trial) const {
    StrainPoint there;
    there.strain = point_.strain + trial.strain_increment;
    there.stress = network_.stress(trial);
    return work_between(point_, there) - (network_.energy(trial.memory) - point_.stored) - trial.dissipated;
}

void StrainPath::begin_section(Index section, double amplitude) {
    section_ = section;
    peak_stress_ *= amplitude_ > 0 ? std::min(1.0, amplitude / amplitude_) : 1.0;
    amplitude_ = amplitude;
}

/// Whether work and energy agree over a step, so that it resolves the path and has not jumped to another branch.
bool StrainPath::is_smooth(const Trial& trial) const {
    const auto [normal, direction] = options_.orientation;
    const double stress = std::max(peak_stress_, std::abs(network_.stress(trial)(normal, direction)));
    const double scale = network_.volume() * stress * std::abs(trial.strain_increment);
    return std::abs(defect(trial)) <=
           options_.balance_tolerance * scale + energy_rounding * point_.stored + network_.least_energy();
}

double StrainPath::smallest_resolved() const {
    return resolution * options_.smallest_step * largest_strain_;
}

double StrainPath::excess(const Trial& trial) const {
    return network_.most_loaded(trial.memory).ratio - 1;
}

/// The strain increment below `increment` at which the first bond reaches its strength, by regula falsi (Illinois), and the
/// equilibrium there. Returns false where an equilibrium between was not found.
bool StrainPath::locate_breakage(double increment, Trial& trial) {
    double low = 0;
    double low_excess = std::min(network_.most_loaded(network_.memories()).ratio - 1, -strength_reached);
    double high = increment;
    double high_excess = excess(trial);
    const double close = options_.event_tolerance * largest_strain_;
    for (int iteration = 0; iteration < most_event_iterations; ++iteration) {
        const double reached = excess(trial);
        if (reached >= 0 && (reached <= strength_reached || std::abs(high - low) <= close)) {
            return true;
        }
        double middle = low - low_excess * (high - low) / (high_excess - low_excess);
        if (std::abs(high - low) <= close) {
            middle = high;
        }
        Trial next;
        const Motion start = (middle / trial.strain_increment) * trial.motion;
        if (!solver_.find(network_, middle, start, next)) {
            return false;
        }
        trial = std::move(next);
        const double now = excess(trial);
        if (now >= 0) {
            high = middle;
            high_excess = now;
            low_excess *= 0.5;
        } else {
            low = middle;
            low_excess = now;
            high_excess *= 0.5;
        }
    }
    return excess(trial) >= 0;
}

/// Breaks bonds one after the other, the most overloaded first, until none is left beyond its strength.
void StrainPath::break_overloaded(const Record& record) {
    bool follows = false;
    for (;;) {
        const ShearedNetwork::Worst worst = network_.most_loaded(network_.memories());
        if (worst.contact < 0 || worst.ratio < 1 - 1e-14 || (follows && worst.ratio <= 1 + strength_reached)) {
            break;
        }
        const ShearedContact& bond = network_.contacts()[static_cast<std::size_t>(worst.contact)];
        broken_.push_back({bond.bond, network_.strain(), worst.limit, follows, section_});
        network_.break_bond(worst.contact);
        const double dissipated = settle();
        const double stored = network_.energy(network_.memories());
        point_.breakage += point_.stored - stored - dissipated;
        point_.dissipated += dissipated;
        point_.stored = stored;
        update_point();
        record(point_);
        follows = true;
    }
    const bool pressed = options_.orientation.is_uniaxial() && network_.strain() < 0;  // the parts come together again
    if (follows && !pressed && !network_.spans()) {
        failure_ = NetworkFailure{network_.strain(), static_cast<Index>(broken_.size())};
    }
}

/// The increment, or what a little more than suffices to break the first bond if all goes on as before.
double StrainPath::up_to_breakage(double increment) {
    Trial there;
    ++effort_.evaluations;
    network_.evaluate(increment, guess(increment), there);
    const double share = network_.first_to_break(there.memory);
    const double least = std::min(std::abs(increment), smallest_resolved());
    return share < worth_shortening ? std::copysign(std::max(least, (1 + overshoot) * share * std::abs(increment)), increment)
                                    : increment;
}

StrainPath::Attempt StrainPath::step(double increment, const Record& record) {
    Trial trial;
    if (!solver_.find(network_, increment, guess(increment), trial)) {
        velocity_.resize(0);
        if (!solver_.find(network_, increment, guess(increment), trial)) {
            return Attempt::no_equilibrium;
        }
    }
    if (network_.reach_used(increment, trial.motion) > 1 || (std::abs(increment) > smallest_resolved() && !is_smooth(trial))) {
        return Attempt::too_long;
    }
    if (excess(trial) <= strength_reached) {
        commit(trial, record);
        return Attempt::done;
    }
    if (!locate_breakage(increment, trial)) {
        return Attempt::no_equilibrium;
    }
    commit(trial, record);
    break_overloaded(record);
    return Attempt::done;
}

/// No equilibrium is near: the network falls to another one.
void StrainPath::jump(double increment, const Record& record) {
    ++effort_.jumps;
    velocity_.resize(0);
    const StrainPoint before = point_;
    Trial trial;
    solver_.minimise(network_, increment, Motion::Zero(6 * network_.particles()), trial, told_);
    if (!std::isfinite(trial.rms_residual)) {
        give_up("by steps of strain as small as " + to_text(std::abs(increment)) + ", nor by a fall to lower energy,");
    }
    network_.commit(trial);
    point_.dissipated += trial.dissipated + settle();
    point_.stored = network_.energy(network_.memories());
    update_point();
    point_.work += work_between(before, point_);
    point_.released += point_.imbalance(before);
    record(point_);
    break_overloaded(record);
}

void StrainPath::go_to(double strain, const Record& record) {
    const double smallest = options_.smallest_step * largest_strain_;
    const double way = std::abs(strain - network_.strain());
    while (!failure_ && std::abs(strain - network_.strain()) > 1e-13 * largest_strain_) {
        part_ = 1 - std::min(1.0, std::abs(strain - network_.strain()) / way);
        tell();
        const double left = strain - network_.strain();
        const bool last = std::abs(left) <= step_ * (1 + 1e-9);
        const double increment = up_to_breakage(last ? left : std::copysign(step_, left));
        const double length = std::abs(increment);
        const Attempt attempt = step(increment, record);
        if (attempt == Attempt::done) {
            step_ = solver_.last_solutions() < easy_solutions ? 2 * std::max(step_, length) : step_;
        } else if (attempt == Attempt::no_equilibrium && length <= smallest * (1 + 1e-6)) {
            jump(increment, record);
        } else {
            step_ = 0.5 * length;
        }
    }
    part_ = 0;
    ++reached_;
}

/// New stiffness grows unstressed, so that no force changes; the network comes to rest again all the same.
void StrainPath::age(double factor) {
    const double before = point_.stored;
    const double lost = network_.age(factor);
    velocity_.resize(0);
    const double dissipated = settle();
    point_.stored = network_.energy(network_.memories());
    point_.dissipated += lost + dissipated;
    point_.released += before - lost - dissipated - point_.stored;
    update_point();
}

}  // namespace coagula::mechanics
