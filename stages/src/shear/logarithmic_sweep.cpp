// SPDX-License-Identifier: GPL-3.0-or-later
#include "logarithmic_sweep.hpp"

#include <coagula/stages/arguments.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/logarithmic_steps.hpp>

#include <charconv>

namespace coagula::stages {

namespace {

constexpr int most_values = 10000;

int parse_number(const std::string& word) {
    int value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || value < 2 || value > most_values) {
        throw InputError("'" + word + "' is not a number of values between 2 and " + std::to_string(most_values));
    }
    return value;
}

}  // namespace

std::vector<double> parse_logarithmic_sweep(const std::string& text, const std::function<double(const std::string&)>& value,
                                            const std::string& example) {
    const std::vector<std::string> parts = split(text, ':');
    if (parts.size() != 3) {
        throw InputError("'" + text + "' is not a range FROM:TO:NUMBER, such as " + example);
    }
    const double from = value(parts[0]);
    const double to = value(parts[1]);
    return logarithmic_steps(from, to, parse_number(parts[2]));
}

}  // namespace coagula::stages
