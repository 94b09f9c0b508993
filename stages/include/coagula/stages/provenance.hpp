// SPDX-License-Identifier: GPL-3.0-or-later
// The entry of a stage in the history of a file.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/arguments.hpp>

#include <chrono>
#include <string>

namespace coagula::stages {

/// Seconds since it was made.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Version and git revision, "0.1.0 (1a2b3c4d5e6f)".
std::string version_text();

/// The entry of this call.
/// @param input packing that went in; null for a generator or an import. @param engine another program that did the work, with its
/// version; empty: none.
io::Provenance describe_call(const Arguments& arguments, const Packing* input, const Stopwatch& clock,
                             const std::string& engine = {});

/// The entry with the time of now and the seconds of the clock.
io::Provenance finished(io::Provenance entry, const Stopwatch& clock);

}  // namespace coagula::stages
