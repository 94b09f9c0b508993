// SPDX-License-Identifier: GPL-3.0-or-later
#include "help_text.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <sstream>

namespace coagula::tools {

namespace {

std::string left_column(const Option& option) {
    std::string text = option.letter != 0 ? std::string("  -") + option.letter + ", --" : std::string("      --");
    text += option.name;
    return option.kind == Option::Kind::flag ? text : text + " " + option.placeholder;
}

}  // namespace

std::string remarks(const Option& option) {
    std::vector<std::string> parts;
    if (option.kind == Option::Kind::quantity) {
        parts.push_back(option.unit == "1" ? "no unit" : "unit " + option.unit);
    }
    for (std::string choices; const std::string& name : option.choices) {
        choices += (choices.empty() ? "" : ", ") + name;
        if (name == option.choices.back()) {
            parts.push_back(choices);
        }
    }
    if (option.required) {
        parts.emplace_back("required");
    } else if (!option.fallback.empty()) {
        parts.push_back("default " + option.fallback);
    }
    if (const std::string range = option.range.text(); !range.empty()) {
        parts.push_back("range " + range);
    }
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? " [" : "; ") + part;
    }
    return text.empty() ? text : text + "]";
}

std::string help_text(const Verb& verb) {
    std::ostringstream text;
    text << "usage: coagula " << verb.name << (verb.input.empty() ? "" : " " + verb.input) << " [options]\n\n"
         << verb.summary << "\n\noptions:\n";
    std::vector<Option> options = all_options(verb);
    std::erase_if(options, [](const Option& option) { return option.name == "input"; });
    std::size_t width = 0;
    for (const Option& option : options) {
        width = std::max(width, left_column(option).size());
    }
    for (const Option& option : options) {
        std::string left = left_column(option);
        left.resize(width + 2, ' ');
        text << left << option.meaning << remarks(option) << '\n';
    }
    for (const std::string& note : verb.notes) {
        text << (note == verb.notes.front() ? "\n" : "") << note << '\n';
    }
    return text.str();
}

}  // namespace coagula::tools
