// SPDX-License-Identifier: GPL-3.0-or-later
// Work in child processes: what one of them does wrong, or what ends it, touches no other.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace coagula::stages {

/// Where the pool stands.
struct PoolState {
    std::size_t done = 0;  ///< pieces of work, also those in which a process died
    std::size_t died = 0;
};

struct Pool {
    std::size_t pieces = 0;
    int jobs = 1;
    int threads = 1;  ///< of each process
    /// Called in a child process for each piece. What it throws ends the pool, as nothing that was computed could be kept.
    std::function<void(std::size_t piece)> work;
    /// Called in this process where a child died of a signal; with the reason.
    std::function<void(std::size_t piece, const std::string& reason)> died;
    /// Called in this process now and then; what it throws ends the pool.
    std::function<void(const PoolState& state)> told;
};

/// Throws std::runtime_error with the sentence of the child whose work threw. All children have ended when this returns or throws;
/// they end with this process, too.
void run_pool(const Pool& pool);

}  // namespace coagula::stages
