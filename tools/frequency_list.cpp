#include "frequency_list.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>

#include <charconv>
#include <cmath>

namespace coagula::tools {

namespace {

constexpr int most_frequencies = 10000;

double parse_frequency(const std::string& word) {
    const double value = io::parse_quantity(word, "Hz");
    if (!(value > 0)) {
        throw InputError("'" + word + "' is out of range: a frequency must be > 0 Hz");
    }
    return value;
}

int parse_number(const std::string& word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < 2 || value > most_frequencies) {
        throw InputError("'" + word + "' is no number of frequencies between 2 and " + std::to_string(most_frequencies));
    }
    return value;
}

/// Names the option in front of the sentence.
template <class Parse>
std::vector<double> named(const std::string& option, const std::string& text, const Parse& parse) {
    try {
        return parse(text);
    } catch (const InputError& error) {
        throw InputError("--" + option + ": " + error.what());
    }
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
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 3) {
        throw InputError("'" + text + "' is no sweep FROM:TO:NUMBER, such as 0.1Hz:1kHz:20");
    }
    const double from = parse_frequency(parts[0]);
    const double to = parse_frequency(parts[1]);
    const int number = parse_number(parts[2]);
    if (!(from < to)) {
        throw InputError("'" + text + "' must run from a lower to a higher frequency");
    }
    std::vector<double> frequencies;
    for (int k = 0; k + 1 < number; ++k) {
        frequencies.push_back(from * std::pow(to / from, static_cast<double>(k) / (number - 1)));
    }
    frequencies.push_back(to);
    return frequencies;
}

std::vector<double> frequencies_of(const Arguments& arguments) {
    if (arguments.has("frequency") && arguments.has("frequency-sweep")) {
        throw InputError("--frequency and --frequency-sweep exclude each other");
    }
    if (arguments.has("frequency-sweep")) {
        return named("frequency-sweep", arguments.text("frequency-sweep"), parse_frequency_sweep);
    }
    return arguments.has("frequency") ? named("frequency", arguments.text("frequency"), parse_frequency_list)
                                      : std::vector<double>{};
}

}  // namespace coagula::tools
