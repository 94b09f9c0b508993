// SPDX-License-Identifier: GPL-3.0-or-later
// A path of equilibria under growing and falling strain, with the bonds that break on it and the balance of energy.
#pragma once

#include "equilibrium.hpp"
#include "sheared_network.hpp"

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace coagula::mechanics {

struct NoEquilibrium : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class StrainPath {
public:
    /// Brings the packing to rest at strain 0.
    /// @param largest_strain of the whole run: smallest step and the tolerance of events are relative to it.
    StrainPath(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model, const QuasistaticOptions& options,
               double largest_strain, const Progress& progress);

    /// Follows the equilibria to a strain; `record` receives each of them, breakage of a bond giving one before and one after.
    void go_to(double strain, const std::function<void(const StrainPoint&)>& record);

    /// How many calls of go_to() the whole run has, for its progress.
    void expect(Index targets) { targets_ = targets; }
    /// What is said beside the progress from here on, such as "cycle 2 of 3".
    void remark(std::string text) { remark_ = std::move(text); }

    const StrainPoint& point() const { return point_; }
    const std::vector<BrokenBond>& broken() const { return broken_; }
    /// Where the network ceased to carry load; go_to() then leaves it there.
    const std::optional<NetworkFailure>& failure() const { return failure_; }
    const SolverEffort& effort() const { return effort_; }

    /// Numbers the sections of a sweep in what is recorded of broken bonds.
    /// @param amplitude of the strain in the section.
    void begin_section(Index section, double amplitude);
    /// See ShearedNetwork::age.
    void age(double factor);

private:
    using Record = std::function<void(const StrainPoint&)>;

    enum class Attempt { done, too_long, no_equilibrium };
    double up_to_breakage(double increment);
    Attempt step(double increment, const Record& record);
    double smallest_resolved() const;
    void commit(Trial& trial, const Record& record);
    double work_between(const StrainPoint& from, const StrainPoint& to) const;
    double defect(const Trial& trial) const;
    bool is_smooth(const Trial& trial) const;
    double excess(const Trial& trial) const;
    bool locate_breakage(double increment, Trial& trial);
    void break_overloaded(const Record& record);
    void jump(double increment, const Record& record);
    double settle();
    Motion guess(double increment);
    void remember(const Trial& trial);
    void update_point();
    void tell() const;
    [[noreturn]] void give_up(const std::string& what) const;

    QuasistaticOptions options_;
    double largest_strain_;
    const Progress& progress_;
    Progress told_;  ///< what the solver says of itself, as that of the path
    Index targets_ = 1;
    Index reached_ = 0;  ///< targets
    double part_ = 0;    ///< of the way to the next one
    std::string remark_;
    SolverEffort effort_;
    ShearedNetwork network_;
    EquilibriumSolver solver_;
    Trial rest_;  ///< the forces of the committed state
    StrainPoint point_;
    std::vector<BrokenBond> broken_;
    std::optional<NetworkFailure> failure_;
    Index section_ = 0;
    double amplitude_ = 0;
    double peak_stress_ = 0;  ///< largest stress on the plates so far [Pa], what is expected at this amplitude after a larger one
    double step_;             ///< of strain that went well
    Motion velocity_;         ///< motion per strain in the last step, empty: unknown
};

}  // namespace coagula::mechanics
