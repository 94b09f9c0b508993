// SPDX-License-Identifier: GPL-3.0-or-later
// Independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace coagula {

/// Calls work(0) ... work(count - 1), several at once where there are threads, but at most `at_once`. What a call does in parallel
/// itself then runs on its own thread alone. After an exception no further call begins; the first one is thrown again.
void run_together(std::size_t count, const std::function<void(std::size_t)>& work,
                  std::size_t at_once = std::numeric_limits<std::size_t>::max());

/// Whether a loop takes long enough for several threads. In a shorter one they wait for each other by spinning, most of all where
/// other work has the processors. @param nanoseconds that a turn takes.
constexpr bool worth_threads(std::ptrdiff_t turns, double nanoseconds) {
    constexpr double shortest = 2e5;
    return static_cast<double>(turns) * nanoseconds >= shortest;
}

/// How many of `wanted` threads, the calling one among them, can be had at once within the limits of the process (threads, address
/// space), each with what the libraries below take for a thread. 0: not even the calling one has room for that.
int threads_within_limits(int wanted);

/// The number of threads to work with: at most `wanted`, at most one for each processor, within the limits; at least 1. OpenMP ends
/// the program where it gets fewer threads than it was told.
int usable_threads(int wanted);

}  // namespace coagula
