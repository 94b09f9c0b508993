// SPDX-License-Identifier: GPL-3.0-or-later
// When the runs on a sample took place: ageing, drying and settling go on between them.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Longest time from the first to the last run on a sample [s].
inline constexpr double longest_session = 366 * 86400.0;

/// Stands for the run before the first one on a sample.
inline constexpr std::size_t no_run = std::numeric_limits<std::size_t>::max();

/// When a run took place. The clock of a sample begins with its first run, or with the rest before that where one is stated.
struct RunTime {
    double origin = 0;            ///< of the times of the table [s]
    double sheared = 0;           ///< end of the last shear that destroyed the structure, else 0 [s]
    bool known = true;            ///< otherwise nothing says which of several runs on the sample came first
    bool runs_on = false;         ///< its times go on from those of the run before it: one clock
    int order = 0;                ///< of the run among those on the sample; equal where nothing says which came first
    std::size_t before = no_run;  ///< the one before it on the sample
};

/// Clocks of every table. A run that states its start, or whose clock runs on from the run before it, is where these say; every
/// other follows the run before it after its pause, 10 s where none is stated, and its pre-shear. Throws InputError where a table
/// states its time twice in different ways, or begins more than a minute before the run before it has ended.
std::vector<RunTime> run_times(const Experiment& experiment);

/// Time of a row on the clock of its table [s]; rows of a table without times follow each other every 10 s.
double time_in(const Measurement& table, std::size_t row);

/// The rows of a table in the order in which they were measured: that of its times, else that of the table.
std::vector<std::size_t> rows_in_time(const Measurement& table);

/// A table whose time is a guess.
struct DoubtfulClock {
    std::string label;
    std::string sample;
    std::string runs_on_from;  ///< label of the run from which its clock seems to run on; empty: nothing says which run came first
};
std::vector<DoubtfulClock> doubtful_clocks(const Experiment& experiment);

}  // namespace coagula::diagnose
