// coagula man: the manual pages.
#include "cli/manual_page.hpp"
#include "cli/output_file.hpp"
#include "cli/provenance.hpp"
#include "cli/report.hpp"
#include "cli/verbs.hpp"

#include <coagula/common/spelling.hpp>
#include <coagula/io/atomic_file.hpp>

#include <filesystem>
#include <iostream>

namespace coagula::tools {

namespace {

/// The page of the verb that the words name; that of the program without words.
std::string page_of(const std::vector<std::string>& words) {
    if (words.empty()) {
        return program_page(all_verbs(), version_text());
    }
    std::string wanted;
    for (const std::string& word : words) {
        wanted += (wanted.empty() ? "" : " ") + word;
    }
    std::vector<std::string> names;
    for (const Verb& verb : all_verbs()) {
        if (verb.name == wanted) {
            return verb_page(verb, version_text());
        }
        names.push_back(verb.name);
    }
    throw InputError("'" + wanted + "' is not a verb" + did_you_mean(wanted, names) + " (see 'coagula --help')");
}

void write_pages(const Arguments& arguments, const std::string& folder) {
    std::filesystem::create_directories(folder);
    std::vector<std::pair<std::string, std::string>> pages = {{"coagula", program_page(all_verbs(), version_text())}};
    for (const Verb& verb : all_verbs()) {
        pages.emplace_back(page_name(verb), verb_page(verb, version_text()));
    }
    Json files = Json::array();
    for (const auto& [name, page] : pages) {
        files.push_back((std::filesystem::path(folder) / (name + ".1")).string());
        check_output(files.back(), arguments.flag("force"));
    }
    for (std::size_t k = 0; k < pages.size(); ++k) {
        io::write_file(files[k], pages[k].second, arguments.flag("force"));
    }
    report(arguments, {{"files", files}}, {{"pages", std::to_string(pages.size())}, {"written to", folder}});
}

void run(const Arguments& arguments) {
    const std::vector<std::string> words = arguments.has("input") ? arguments.inputs() : std::vector<std::string>{};
    if (arguments.has("output")) {
        if (!words.empty()) {
            throw InputError("--output writes the pages of all verbs: leave VERB out");
        }
        write_pages(arguments, arguments.text("output"));
        return;
    }
    const std::string page = page_of(words);
    if (arguments.flag("json")) {
        report(arguments, {{"page", page}}, {});
        return;
    }
    std::cout << page;
    flush_output();
}

}  // namespace

Verb man_verb() {
    Option folder = text("output", "FOLDER", "write the pages of the program and of all verbs into this folder instead");
    folder.letter = 'o';
    return {.name = "man",
            .summary = "print the manual page of the program or of a verb, for man(1)",
            .input = "VERB",
            .options = {folder, flag("force", "replace existing pages")},
            .run = run,
            .notes = {"To read a page: coagula man shear | man -l -"},
            .many_inputs = true,
            .input_required = false};
}

}  // namespace coagula::tools
