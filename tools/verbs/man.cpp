// SPDX-License-Identifier: GPL-3.0-or-later
// coagula man: the manual pages, and the same for the manual in Markdown.
#include "cli/manual_page.hpp"
#include "cli/markdown_page.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/spelling.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/stages/output_file.hpp>

#include <filesystem>
#include <iostream>

namespace coagula::tools {

namespace {

bool is_markdown(const Arguments& arguments) {
    return arguments.text("format") == "markdown";
}

std::string page_of_program(const Arguments& arguments) {
    return is_markdown(arguments) ? program_markdown(all_verbs()) : program_page(all_verbs(), version_text());
}

std::string page_of_verb(const Arguments& arguments, const Verb& verb) {
    return is_markdown(arguments) ? verb_markdown(verb) : verb_page(verb, version_text());
}

/// The page of the verb that the words name; that of the program without words.
std::string page_of(const Arguments& arguments, const std::vector<std::string>& words) {
    if (words.empty()) {
        return page_of_program(arguments);
    }
    std::string wanted;
    for (const std::string& word : words) {
        wanted += (wanted.empty() ? "" : " ") + word;
    }
    std::vector<std::string> names;
    for (const Verb& verb : all_verbs()) {
        if (verb.name == wanted) {
            return page_of_verb(arguments, verb);
        }
        names.push_back(verb.name);
    }
    throw InputError("'" + wanted + "' is not a verb" + did_you_mean(wanted, names) + " (see 'coagula --help')");
}

void write_pages(const Arguments& arguments, const std::string& folder) {
    io::make_folder(folder);
    std::vector<std::pair<std::string, std::string>> pages = {{"coagula", page_of_program(arguments)}};
    for (const Verb& verb : all_verbs()) {
        pages.emplace_back(page_name(verb), page_of_verb(arguments, verb));
    }
    const std::string ending = is_markdown(arguments) ? ".md" : ".1";
    Json files = Json::array();
    for (const auto& [name, page] : pages) {
        files.push_back((std::filesystem::path(folder) / (name + ending)).string());
        check_output(arguments, files.back());
    }
    for (std::size_t k = 0; k < pages.size(); ++k) {
        io::write_file(files[k], pages[k].second, arguments.flag("force"));
    }
    report(arguments, {{"files", files}}, {{"pages", std::to_string(pages.size())}, {"written to", folder}});
}

}  // namespace

void run_man(const Arguments& arguments) {
    const std::vector<std::string> words = arguments.has("input") ? arguments.inputs() : std::vector<std::string>{};
    if (arguments.has("output")) {
        if (!words.empty()) {
            throw InputError("--output writes the pages of all verbs: leave VERB out");
        }
        write_pages(arguments, arguments.text("output"));
        return;
    }
    const std::string page = page_of(arguments, words);
    if (arguments.flag("json")) {
        report(arguments, {{"page", page}}, {});
        return;
    }
    std::cout << page;
    flush_output();
}

Verb man_verb() {
    Option folder = stages::text("output", "FOLDER", "write the pages of the program and of all verbs into this folder instead");
    folder.letter = 'o';
    return {
        .name = "man",
        .summary = "print the manual page of the program or of a verb, for man(1)",
        .input = "VERB",
        .options = {stages::choice("format", {"man", "markdown"}, "man: a page for man(1); markdown: a page of the manual", "man"),
                    folder, stages::flag("force", "replace existing pages")},
        .notes = {"To read a page: coagula man shear | man -l -"},
        .many_inputs = true,
        .input_required = false};
}

}  // namespace coagula::tools
