// SPDX-License-Identifier: GPL-3.0-or-later
#include "rheometer_headings.hpp"

#include "heading_list.hpp"
#include "text_reader.hpp"

#include <coagula/io/measured_file.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <unordered_map>
#include <utility>

namespace coagula::io {

namespace {

constexpr std::size_t longest_heading = 100;  ///< bytes; none of the list comes near

using Replacements = std::initializer_list<std::pair<std::string_view, std::string_view>>;

std::string replaced(std::string text, const Replacements& replacements) {
    for (const auto& [from, to] : replacements) {
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
            text.replace(at, from.size(), to);
        }
    }
    return text;
}

/// Primes and dashes as a typewriter has them, and Greek letters where others look like them.
std::string plain_name(std::string_view heading) {
    std::string name = replaced(std::string(trim(heading)), {{"′", "'"},
                                                             {"’", "'"},
                                                             {"‘", "'"},
                                                             {"ʹ", "'"},
                                                             {"ˈ", "'"},
                                                             {"´", "'"},
                                                             {"`", "'"},
                                                             {"″", "''"},
                                                             {"”", "''"},
                                                             {"“", "''"},
                                                             {"\"", "''"},
                                                             {"Ω", "ω"},
                                                             {"ɣ", "γ"},
                                                             {"ɷ", "ω"},
                                                             {"_", " "}});
    return name.size() == 1 ? name : lower_case(name);
}

bool is_unit(std::string_view text) {
    return text == "1" || is_unit_text(normal_unit(text));
}

/// The parts of a heading whose left one is known and whose right one is a unit.
std::optional<HeadingWithUnit> split_at(std::string_view text, std::size_t at, std::size_t width) {
    const std::string_view name = trim(text.substr(0, at));
    const std::string_view unit = trim(text.substr(at + width));
    const bool may_be_a_name = width == 1 && text[at] == ' ' && unit.size() == 1 && unit != "%";  // "G' A" of sample A
    if (unit.empty() || may_be_a_name || known_heading(name).quantity.empty() || !is_unit(unit)) {
        return std::nullopt;
    }
    return HeadingWithUnit{std::string(name), normal_unit(unit)};
}

/// "ShearRate" as two words.
std::string parted_words(std::string_view heading) {
    std::string parted;
    for (const char c : heading) {
        const bool begins_word = c >= 'A' && c <= 'Z' && !parted.empty() && parted.back() >= 'a' && parted.back() <= 'z';
        parted += begins_word ? std::string{' ', c} : std::string{c};
    }
    return parted;
}

/// The heading as it stands in the list.
KnownHeading listed(std::string_view heading) {
    static const std::unordered_map<std::string_view, std::size_t> places = [] {
        std::unordered_map<std::string_view, std::size_t> map;
        for (std::size_t place = 0; place < heading_list.size(); ++place) {
            map.emplace(heading_list[place].first, place);
        }
        return map;
    }();
    const std::string name = plain_name(heading);
    auto found = places.find(name);
    const std::string lower = lower_case(name);
    found = found == places.end() ? places.find(lower) : found;
    found = found == places.end() ? places.find(plain_name(parted_words(heading))) : found;
    return found == places.end() ? KnownHeading{} : KnownHeading{std::string(heading_list[found->second].second), found->second};
}

/// A part of a heading without the marks and brackets that separate a word from its symbol.
std::string_view bare_part(std::string_view part) {
    constexpr std::string_view marks = " ,;:=-/";
    part.remove_prefix(std::min(part.find_first_not_of(marks), part.size()));
    part = part.substr(0, part.find_last_not_of(marks) + 1);
    const bool in_brackets =
        part.size() > 2 && ((part.front() == '(' && part.back() == ')') || (part.front() == '[' && part.back() == ']'));
    return in_brackets ? part.substr(1, part.size() - 2) : part;
}

/// "Storage modulus (G')", "Speichermodul G'", "ω, angular frequency": two known headings that mean the same.
KnownHeading listed_twice(std::string_view heading) {
    for (std::size_t i = 1; i + 1 < heading.size(); ++i) {
        if (std::string_view(" ([,:=-/").find(heading[i]) == std::string_view::npos) {
            continue;
        }
        KnownHeading one = listed(bare_part(heading.substr(0, i)));
        if (!one.quantity.empty() && one.quantity == listed(bare_part(heading.substr(i))).quantity) {
            return one;
        }
    }
    return {};
}

}  // namespace

KnownHeading known_heading(std::string_view heading) {
    if (heading.size() > longest_heading) {
        return {};
    }
    KnownHeading known = listed(heading);
    return known.quantity.empty() ? listed_twice(trim(heading)) : known;
}

std::string quantity_of_heading(std::string_view heading) {
    return known_heading(heading).quantity;
}

std::string normal_unit(std::string_view text) {
    text = trim(text);
    if (text.size() >= 2 && ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'))) {
        text = trim(text.substr(1, text.size() - 2));
    }
    if (text == "-" || text == "—" || text == "–") {
        return "1";
    }
    std::string unit = replaced(std::string(text), {{"・", "."},
                                                    {"·", "."},
                                                    {"⋅", "."},
                                                    {"*", "."},
                                                    {"⁻¹", "-1"},
                                                    {"⁻²", "-2"},
                                                    {"N m", "N.m"},
                                                    {"Nm", "N.m"},
                                                    {"Pa s", "Pa.s"},
                                                    {"Pa_s", "Pa.s"},
                                                    {"rad_s", "rad/s"},
                                                    {"1_s", "1/s"}});
    if (unit.ends_with("Pas")) {
        unit.insert(unit.size() - 1, ".");
    }
    const bool per_torque = unit.ends_with("/N.m");
    return per_torque ? unit.substr(0, unit.size() - 3) + "(N.m)" : unit;
}

HeadingWithUnit split_heading(std::string_view text) {
    text = trim(text);
    if (!known_heading(text).quantity.empty()) {
        return {std::string(text), ""};
    }
    if (const std::size_t begin = text.rfind('['); text.ends_with(']') && begin != std::string_view::npos && begin > 0) {
        return {std::string(trim(text.substr(0, begin))), normal_unit(text.substr(begin))};
    }
    if (const std::size_t begin = text.rfind('('); text.ends_with(')') && begin != std::string_view::npos && begin > 0) {
        const std::string unit = normal_unit(text.substr(begin));
        return is_unit(unit) ? HeadingWithUnit{std::string(trim(text.substr(0, begin))), unit}
                             : HeadingWithUnit{std::string(text), ""};
    }
    for (const std::string_view separator : {" / ", " in ", " en ", "/", ", ", "_", " "}) {
        for (std::size_t at = text.find(separator, 1); at != std::string_view::npos; at = text.find(separator, at + 1)) {
            if (auto parts = split_at(text, at, separator.size())) {
                return std::move(*parts);
            }
        }
    }
    return {std::string(text), ""};
}

}  // namespace coagula::io
