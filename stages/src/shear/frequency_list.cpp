// SPDX-License-Identifier: GPL-3.0-or-later
#include "frequency_list.hpp"

#include "logarithmic_sweep.hpp"

#include <coagula/common/checks.hpp>

#include <numbers>

namespace coagula::stages {

namespace {

constexpr std::size_t most_frequencies = 10000;

/// In Hz, or in rad/s as rheometers write angular frequencies.
double parse_frequency(const std::string& word) {
    if (word.ends_with("rad/s")) {
        constexpr double turn = 2 * std::numbers::pi;
        return parse_quantity(word, "rad/s", within(turn * physical::frequency.low, turn * physical::frequency.high)) / turn;
    }
    return parse_quantity(word, "Hz", physical::frequency);
}

}  // namespace

std::vector<double> parse_frequency_list(const std::string& text) {
    std::vector<double> frequencies;
    for (const std::string& word : split(text)) {
        frequencies.push_back(parse_frequency(word));
    }
    if (frequencies.empty() || frequencies.size() > most_frequencies) {
        throw InputError("between 1 and " + std::to_string(most_frequencies) + " frequencies are possible");
    }
    return frequencies;
}

std::vector<double> parse_frequency_sweep(const std::string& text) {
    std::vector<double> frequencies = parse_logarithmic_sweep(text, parse_frequency, "0.1Hz:1kHz:20");
    if (!(frequencies.front() < frequencies.back())) {
        throw InputError("'" + text + "' must run from a lower to a higher frequency");
    }
    return frequencies;
}

std::vector<double> frequencies_of(const Arguments& arguments) {
    if (arguments.has("frequency") && arguments.has("frequency-sweep")) {
        throw InputError(arguments.spelled("frequency") + " and " + arguments.spelled("frequency-sweep") + " exclude each other");
    }
    if (arguments.has("frequency-sweep")) {
        return arguments.parsed("frequency-sweep", parse_frequency_sweep);
    }
    return arguments.has("frequency") ? arguments.parsed("frequency", parse_frequency_list) : std::vector<double>{};
}

}  // namespace coagula::stages
