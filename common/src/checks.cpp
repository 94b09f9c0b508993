// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>

#include <array>
#include <charconv>
#include <cmath>

namespace coagula {

namespace {

[[noreturn]] void fail(double value, std::string_view object, std::string_view unit, std::string_view rule) {
    std::string sentence{object};
    sentence += " is " + to_text(value);
    if (!unit.empty()) {
        sentence += ' ';
        sentence += unit;
    }
    sentence += ", but must be ";
    sentence += rule;
    throw std::invalid_argument(sentence);
}

}  // namespace

std::string to_text(double value) {
    std::array<char, 32> buffer{};
    auto* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

void require(bool condition, std::string_view sentence) {
    if (!condition) {
        throw std::invalid_argument(std::string{sentence});
    }
}

double require_positive(double value, std::string_view object, std::string_view unit) {
    if (!(std::isfinite(value) && value > 0)) {
        fail(value, object, unit, "finite and positive");
    }
    return value;
}

double require_non_negative(double value, std::string_view object, std::string_view unit) {
    if (!(std::isfinite(value) && value >= 0)) {
        fail(value, object, unit, "finite and not negative");
    }
    return value;
}

double require_between(double value, double low, double high, std::string_view object, std::string_view unit) {
    if (!(value > low && value < high)) {
        fail(value, object, unit, "greater than " + to_text(low) + " and less than " + to_text(high));
    }
    return value;
}

}  // namespace coagula
