// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/experiment/simulation_cache.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/io/checksums.hpp>
#include <coagula/io/input_file.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace coagula::experiment {

namespace {

/// Finite numbers with one space between them; nothing when there is anything else.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
    std::vector<double> values;
    const char* place = text.data();
    const char* const end = place + text.size();
    while (true) {
        double value = 0;
        const auto [behind, problem] = std::from_chars(place, end, value);
        if (problem != std::errc() || !std::isfinite(value)) {
            return std::nullopt;
        }
        values.push_back(value);
        if (behind == end) {
            return values;
        }
        if (*behind != ' ') {
            return std::nullopt;
        }
        place = behind + 1;
    }
}

constexpr std::size_t checksum_digits = 16;

std::string checksum_of(std::string_view text) {
    return io::sha256(text).substr(0, checksum_digits);
}

/// Key and numbers of a line; nothing when it is not as it was written.
std::optional<diagnose::SimulationCache::value_type> result_of(std::string_view line) {
    const std::size_t tab = line.find('\t');
    const std::size_t last = line.rfind('\t');
    if (tab == last || line.substr(last + 1) != checksum_of(line.substr(0, last))) {
        return std::nullopt;
    }
    std::optional<std::vector<double>> values = numbers_of(line.substr(tab + 1, last - tab - 1));
    return values ? std::optional<diagnose::SimulationCache::value_type>({std::string(line.substr(0, tab)), *std::move(values)})
                  : std::nullopt;
}

}  // namespace

diagnose::SimulationCache read_cache(const std::filesystem::path& path) {
    diagnose::SimulationCache cache;
    if (!std::filesystem::exists(path)) {
        return cache;
    }
    const std::string text = io::read_file(path.string());
    std::string_view rest = text;
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        std::optional<diagnose::SimulationCache::value_type> result =
            end == std::string_view::npos ? std::nullopt : result_of(rest.substr(0, end));
        if (!result) {
            throw InputError(path.string() + ": line " + std::to_string(line) +
                             " is no result of a simulation as it was written: it was cut off, changed, or comes from an older "
                             "version; remove the file, and what it held is simulated again");
        }
        cache.insert_or_assign(result->first, std::move(result->second));
        rest.remove_prefix(end + 1);
    }
    return cache;
}

std::string cache_text(const diagnose::SimulationCache& cache) {
    std::string text;
    for (const auto& [key, values] : cache) {
        if (values.empty() || !std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) {
            continue;
        }
        std::string line = key + "\t";
        for (std::size_t k = 0; k < values.size(); ++k) {
            line += (k > 0 ? " " : "") + to_text(values[k]);
        }
        text += line + "\t" + checksum_of(line) + "\n";
    }
    return text;
}

}  // namespace coagula::experiment
