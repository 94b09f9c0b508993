// SPDX-License-Identifier: GPL-3.0-or-later
#include "manual_page.hpp"

#include "help_text.hpp"

#include <algorithm>
#include <cctype>

namespace coagula::tools {

namespace {

/// Text as troff has to see it: '-' is the sign that can be copied, and no line begins with a control character.
std::string troff_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else if (c == '\'' || c == '.') {
            out += (out.empty() ? "\\&" : "") + std::string(1, c);
        } else {
            out += c;
        }
    }
    return out;
}

std::string bold(const std::string& text) {
    return "\\fB" + troff_text(text) + "\\fR";
}

std::string italic(const std::string& text) {
    return "\\fI" + troff_text(text) + "\\fR";
}

std::string title(const std::string& name, const std::string& version) {
    std::string capitals = name;
    std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return ".TH " + troff_text(capitals) + " 1 \"\" \"coagula " + troff_text(version) + "\" \"coagula\"\n";
}

std::string entry(const Option& option) {
    std::string heading = option.letter != 0 ? bold(std::string("-") + option.letter) + ", " : std::string{};
    heading += bold("--" + option.name);
    if (option.kind != Option::Kind::flag) {
        heading += " " + italic(option.placeholder);
    }
    return ".TP\n" + heading + "\n" + troff_text(option.meaning + remarks(option)) + "\n";
}

constexpr const char* common_parts =
    ".SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\nfailed\n.TP\n.B 2\nwrong usage or bad input\n"
    ".TP\n.B 3\nwhat would be written exists already, and --force was not given\n"
    ".TP\n.B 4\nno structure has what was asked for, such as a coordination number at this volume fraction\n"
    ".SH NOTES\nQuantities are SI numbers or carry a unit: 0.25um, 100N/m, 10 mM. Whole numbers may be written 1e6.\n"
    "Results go to a temporary file that is renamed when it is complete.\n";

}  // namespace

std::string page_name(const Verb& verb) {
    std::string name = "coagula-" + verb.name;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

std::string program_page(const std::vector<Verb>& verbs, const std::string& version) {
    std::string text =
        title("coagula", version) + ".SH NAME\ncoagula \\- random sphere packings and coagulated particle gels\n" +
        ".SH SYNOPSIS\n.B coagula\n.I VERB\n.RI [ options ]\n.br\n.B coagula \\-\\-help\n.br\n.B coagula \\-\\-version\n" +
        ".SH DESCRIPTION\nGenerates, characterizes and shears packings, and diagnoses measured moduli.\n.SH VERBS\n";
    std::string pages;
    for (const Verb& verb : verbs) {
        text += ".TP\n" + bold(verb.name) + "\n" + troff_text(verb.summary) + "\n";
        pages += ".BR " + troff_text(page_name(verb)) + (verb.name == verbs.back().name ? " (1)\n" : " (1),\n");
    }
    return text + common_parts + ".SH SEE ALSO\n" + pages;
}

std::string verb_page(const Verb& verb, const std::string& version) {
    std::string text = title(page_name(verb), version) + ".SH NAME\n" + troff_text(page_name(verb)) + " \\- " +
                       troff_text(verb.summary) + "\n.SH SYNOPSIS\n" + bold("coagula " + verb.name) +
                       (verb.input.empty() ? "" : " " + italic(verb.input)) + " [options]\n.SH DESCRIPTION\n" +
                       troff_text(verb.summary) + "\n";
    for (const std::string& note : verb.notes) {
        text += ".PP\n" + troff_text(note) + "\n";
    }
    text += ".SH OPTIONS\n";
    for (const Option& option : all_options(verb)) {
        text += option.name == "input" ? "" : entry(option);
    }
    return text + common_parts + ".SH SEE ALSO\n.BR coagula (1)\n";
}

}  // namespace coagula::tools
