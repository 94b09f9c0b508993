#include <coagula/experiment/simulation_cache.hpp>

#include <coagula/common/checks.hpp>
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

}  // namespace

diagnose::SimulationCache read_cache(const std::filesystem::path& path) {
    diagnose::SimulationCache cache;
    if (!std::filesystem::exists(path)) {
        return cache;
    }
    const std::string text = io::read_file(path.string());
    std::string_view rest = text;
    for (int line = 1; !rest.empty(); ++line) {
        const std::size_t tab = std::min(rest.find('\t'), rest.size());
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const bool whole = tab < end && end < rest.size();
        std::optional<std::vector<double>> values = whole ? numbers_of(rest.substr(tab + 1, end - tab - 1)) : std::nullopt;
        if (!values) {
            throw InputError(path.string() + ": line " + std::to_string(line) +
                             " is not a complete result of a simulation; remove the file to simulate it again");
        }
        cache.insert_or_assign(std::string(rest.substr(0, tab)), *std::move(values));
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
        text += key + "\t";
        for (std::size_t k = 0; k < values.size(); ++k) {
            text += (k > 0 ? " " : "") + to_text(values[k]);
        }
        text += "\n";
    }
    return text;
}

}  // namespace coagula::experiment
