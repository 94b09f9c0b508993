// SPDX-License-Identifier: GPL-3.0-or-later
#include "version.hpp"

#include <coagula/stages/provenance.hpp>

#include <array>
#include <ctime>

namespace coagula::stages {

namespace {

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    std::array<char, 32> buffer{};
    return {buffer.data(), std::strftime(buffer.data(), buffer.size(), "%Y-%m-%dT%H:%M:%SZ", &parts)};
}

}  // namespace

std::string version_text() {
    std::string text = version;
    text += " (";
    text += revision;
    text += ")";
    return text;
}

io::Provenance describe_call(const Arguments& arguments, const Packing* input, const Stopwatch& clock, const std::string& engine) {
    io::Provenance entry;
    entry.stage = arguments.verb();
    entry.command_line = arguments.call();
    entry.options = arguments.to_json().dump();
    entry.seed = arguments.has("seed") ? arguments.count("seed") : -1;
    entry.version = version_text() + (engine.empty() ? "" : ", " + engine);
    entry.positions_sha256 = input != nullptr ? io::positions_sha256(*input) : std::string{};
    return finished(std::move(entry), clock);
}

io::Provenance finished(io::Provenance entry, const Stopwatch& clock) {
    entry.time = utc_now();
    entry.seconds = clock.seconds();
    return entry;
}

}  // namespace coagula::stages
