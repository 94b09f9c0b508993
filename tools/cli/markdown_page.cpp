// SPDX-License-Identifier: GPL-3.0-or-later
#include "markdown_page.hpp"

#include "manual_page.hpp"

#include <string_view>

namespace coagula::tools {

namespace {

/// Text without a meaning to Markdown, also inside a table.
std::string markdown_text(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (std::string_view("\\`*_<>[]|$~#").find(c) != std::string_view::npos) {
            out += '\\';
        }
        out += c;
    }
    return out;
}

/// As code inside a table, where a bar would end the cell.
std::string code(std::string_view text) {
    std::string out = "`";
    for (const char c : text) {
        out += c == '|' ? "\\|" : std::string(1, c);
    }
    return out + "`";
}

std::string code_list(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) {
        out += (out.empty() ? "" : ", ") + code(word);
    }
    return out;
}

/// Choices, unit and range.
std::string value_column(const Option& option) {
    std::string out = code_list(option.choices);
    if (option.kind == Option::Kind::quantity && option.unit != "1") {
        out += markdown_text(option.unit);
    }
    const std::string range = option.range.text();
    return out + (out.empty() || range.empty() ? "" : ", ") + markdown_text(range);
}

std::string row(const Option& option) {
    std::string name = "--" + option.name;
    if (option.kind != Option::Kind::flag) {
        name += " " + option.placeholder;
    }
    const std::string letter = option.letter == 0 ? "" : code(std::string("-") + option.letter) + ", ";
    const std::string fallback = option.required ? "required" : option.fallback.empty() ? "" : code(option.fallback);
    return "| " + letter + code(name) + " | " + value_column(option) + " | " + fallback + " | " + markdown_text(option.meaning) +
           " |\n";
}

std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    }
    return text;
}

/// Paragraphs; indented lines, which list things, are kept as they are.
std::string notes_of(const Verb& verb) {
    std::string out;
    bool in_list = false;
    for (const std::string& note : verb.notes) {
        const bool listed = note.front() == ' ';
        out += listed == in_list ? "" : listed ? "```text\n" : "```\n\n";
        out += listed ? note + "\n" : markdown_text(note) + "\n\n";
        in_list = listed;
    }
    return out + (in_list ? "```\n\n" : "");
}

}  // namespace

std::string program_markdown(const std::vector<Verb>& verbs) {
    std::string text = "# The verbs\n\n| verb | what it does |\n|---|---|\n";
    std::string pages;
    for (const Verb& verb : verbs) {
        text += "| [" + code("coagula " + verb.name) + "](" + page_name(verb) + ".md) | " + markdown_text(verb.summary) + " |\n";
        pages += page_name(verb) + "\n";
    }
    return text + "\n```{toctree}\n:hidden:\n\n" + pages + "```\n";
}

std::string verb_markdown(const Verb& verb) {
    std::string text = "# coagula " + verb.name + "\n\n" + markdown_text(capitalised(verb.summary)) + ".\n\n```text\ncoagula " +
                       verb.name + (verb.input.empty() ? "" : " " + verb.input) + " [options]\n```\n\n";
    text += notes_of(verb) + "| option | value | default | meaning |\n|---|---|---|---|\n";
    for (const Option& option : all_options(verb)) {
        text += option.name == "input" ? "" : row(option);
    }
    return text;
}

}  // namespace coagula::tools
