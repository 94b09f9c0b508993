// SPDX-License-Identifier: GPL-3.0-or-later
#include "completion.hpp"

#include "help_text.hpp"

#include <algorithm>
#include <utility>

namespace coagula::tools {

namespace {

/// What the value of an option or an argument is.
struct Value {
    enum class Kind { none, words, file, folder };
    Kind kind = Kind::none;
    std::string ending = {};  ///< of a file, ".h5"; empty: any
};

Value value_of(const Option& option) {
    const std::string name = option.placeholder.substr(0, option.placeholder.find(' '));
    const std::size_t dot = name.rfind('.');
    if (!option.choices.empty()) {
        return {Value::Kind::words};
    }
    if (name.starts_with("FOLDER")) {
        return {Value::Kind::folder};
    }
    if (option.kind == Option::Kind::text && (name.starts_with("FILE") || dot != std::string::npos)) {
        return {Value::Kind::file, dot == std::string::npos || dot + 1 >= name.size() ? "" : name.substr(dot)};
    }
    return {};
}

std::string joined(const std::vector<std::string>& words, const std::string& between = " ") {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : between) + word;
    }
    return text;
}

/// Whether the first word of some verbs is a verb by itself.
bool is_verb(const std::vector<Verb>& verbs, const std::string& word) {
    return std::any_of(verbs.begin(), verbs.end(), [&](const Verb& verb) { return verb.name == word; });
}

/// First words of verbs of two words, with the second ones: "generate" with "vem brownian".
std::vector<std::pair<std::string, std::vector<std::string>>> families(const std::vector<Verb>& verbs) {
    std::vector<std::pair<std::string, std::vector<std::string>>> found;
    for (const Verb& verb : verbs) {
        const std::size_t blank = verb.name.find(' ');
        if (blank == std::string::npos) {
            continue;
        }
        const std::string first = verb.name.substr(0, blank);
        if (found.empty() || found.back().first != first) {
            found.emplace_back(first, std::vector<std::string>{});
        }
        found.back().second.push_back(verb.name.substr(blank + 1));
    }
    return found;
}

std::vector<std::string> first_words(const std::vector<Verb>& verbs) {
    std::vector<std::string> words;
    for (const Verb& verb : verbs) {
        const std::string first = verb.name.substr(0, verb.name.find(' '));
        if (words.empty() || words.back() != first) {
            words.push_back(first);
        }
    }
    return words;
}

/// The command of bash that completes a value; empty when nothing is known about it.
std::string bash_value(const Option& option) {
    const Value value = value_of(option);
    switch (value.kind) {
        case Value::Kind::words:
            return "_coagula_words '" + joined(option.choices) + "'";
        case Value::Kind::file:
            return "_coagula_files '" + value.ending + "'";
        case Value::Kind::folder:
            return "_coagula_folders";
        case Value::Kind::none:
            break;
    }
    return "";
}

/// The case of one verb: the value of the option before the cursor, else names of options or the argument without a name.
std::string bash_verb(const Verb& verb) {
    std::string values;
    std::string unknown;  // whose values nobody can guess
    std::string names;
    std::string argument;
    for (const Option& option : all_options(verb)) {
        if (option.name == "input") {
            argument = bash_value(option);
            continue;
        }
        names += (names.empty() ? "--" : " --") + option.name;
        if (option.kind != Option::Kind::flag) {
            const std::string name = "--" + option.name + (option.letter != 0 ? std::string("|-") + option.letter : std::string{});
            const std::string command = bash_value(option);
            if (command.empty()) {
                unknown += (unknown.empty() ? "" : "|") + name;
            } else {
                values += "                " + name + ") " + command + "; return ;;\n";
            }
        }
    }
    if (!unknown.empty()) {
        values += "                " + unknown + ") return ;;\n";
    }
    std::string text = "        '" + verb.name + "')\n            case $previous in\n" + values + "            esac\n";
    text += "            if [[ $current == -* ]]; then\n                _coagula_words '" + names + "'\n            else\n";
    return text + "                " + (argument.empty() ? ":" : argument) + "\n            fi\n            ;;\n";
}

/// As a part of a text in single quotes for zsh: a specification of _arguments, where some characters have a meaning.
std::string zsh_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\'') {
            out += "'\\''";
            continue;
        }
        if (c == '[' || c == ']' || c == ':' || c == '\\') {
            out += '\\';
        }
        out += c;
    }
    return out;
}

std::string zsh_value(const Option& option) {
    const Value value = value_of(option);
    const std::string label = ":" + zsh_text(option.placeholder.empty() ? "argument" : option.placeholder) + ":";
    switch (value.kind) {
        case Value::Kind::words:
            return label + "(" + joined(option.choices) + ")";
        case Value::Kind::file:
            return label + (value.ending.empty() ? "_files" : "_files -g \"*" + value.ending + "\"");
        case Value::Kind::folder:
            return label + "_files -/";
        case Value::Kind::none:
            break;
    }
    return label + " ";
}

std::string zsh_verb(const Verb& verb) {
    std::string text = "        ('" + verb.name + "')\n            _arguments";
    for (const Option& option : all_options(verb)) {
        text += " \\\n                ";
        if (option.name == "input") {
            text += "'*" + zsh_value(option) + "'";
            continue;
        }
        const std::string meaning = "[" + zsh_text(option.meaning + remarks(option)) + "]";
        const std::string value = option.kind == Option::Kind::flag ? std::string{} : zsh_value(option);
        const std::string name = "--" + option.name;
        if (option.letter == 0) {
            text += "'" + name + meaning + value + "'";
        } else {
            const std::string letter = std::string("-") + option.letter;
            text += "'(" + letter + " " + name + ")'{" + letter + "," + name + "}'" + meaning + value + "'";
        }
    }
    return text + "\n            ;;\n";
}

std::string zsh_names(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += " '" + zsh_text(word) + "'";
    }
    return text;
}

constexpr const char* bash_head = R"(# Completion of coagula in bash, written by 'coagula completion bash'.

_coagula_words() {
    mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current")
}

_coagula_folders() {
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$current")
}

# Files with this ending, and folders on the way to them.
_coagula_files() {
    compopt -o filenames 2>/dev/null
    if [[ -z $1 ]]; then
        mapfile -t COMPREPLY < <(compgen -f -- "$current")
    else
        mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -X "!*$1" -- "$current")
    fi
}

_coagula() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
    if [[ $current == '=' ]]; then # the shell takes --option=value apart
        current=''
    elif [[ $previous == '=' && $COMP_CWORD -gt 1 ]]; then
        previous=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    COMPREPLY=()
    if ((COMP_CWORD < 2)); then
        _coagula_words '@WORDS@ --help --version'
        return
    fi
    case $verb in
@FAMILIES@    esac
    case $verb in
)";

constexpr const char* bash_tail = R"(    esac
}

complete -F _coagula coagula
)";

constexpr const char* zsh_head = R"(#compdef coagula
# Completion of coagula in zsh, written by 'coagula completion zsh'.

_coagula() {
    local verb=$words[2]
    if ((CURRENT == 2)); then
        compadd --@WORDS@ '--help' '--version'
        return
    fi
    case $verb in
@FAMILIES@    esac
    shift words
    ((CURRENT -= 1))
    case $verb in
)";

constexpr const char* zsh_tail = R"(    esac
}

_coagula "$@"
)";

std::string filled(std::string text, const std::string& mark, const std::string& value) {
    text.replace(text.find(mark), mark.size(), value);
    return text;
}

}  // namespace

std::string bash_completion(const std::vector<Verb>& verbs) {
    std::string second;
    for (const auto& [first, words] : families(verbs)) {
        if (is_verb(verbs, first)) {
            second +=
                "        " + first + ")\n            if ((COMP_CWORD > 2)); then\n                case ${COMP_WORDS[2]} in\n" +
                "                    " + joined(words, "|") + ") verb+=\" ${COMP_WORDS[2]}\" ;;\n                esac\n" +
                "            elif [[ -n $current && ' " + joined(words) + "' == *\" $current\"* ]]; then\n" +
                "                _coagula_words '" + joined(words) + "'\n                return\n            fi\n            ;;\n";
            continue;
        }
        second += "        " + first + ")\n            if ((COMP_CWORD == 2)); then\n                _coagula_words '" +
                  joined(words) +
                  "'\n                return\n            fi\n            verb+=\" ${COMP_WORDS[2]}\"\n            ;;\n";
    }
    std::string text = filled(filled(bash_head, "@WORDS@", joined(first_words(verbs))), "@FAMILIES@", second);
    for (const Verb& verb : verbs) {
        text += bash_verb(verb);
    }
    return text + bash_tail;
}

std::string zsh_completion(const std::vector<Verb>& verbs) {
    std::string second;
    for (const auto& [first, words] : families(verbs)) {
        if (is_verb(verbs, first)) {
            second += "        (" + first + ")\n            if ((CURRENT == 3)); then\n                compadd --" +
                      zsh_names(words) + "\n            elif [[ \" " + joined(words) + " \" == *\" $words[3] \"* ]]; then\n" +
                      "                verb+=\" $words[3]\"\n                shift words\n                ((CURRENT -= 1))\n"
                      "            fi\n            ;;\n";
            continue;
        }
        second += "        (" + first + ")\n            if ((CURRENT == 3)); then\n                compadd --" + zsh_names(words) +
                  "\n                return\n            fi\n            verb+=\" $words[3]\"\n            shift words\n"
                  "            ((CURRENT -= 1))\n            ;;\n";
    }
    std::string text = filled(filled(zsh_head, "@WORDS@", zsh_names(first_words(verbs))), "@FAMILIES@", second);
    for (const Verb& verb : verbs) {
        text += zsh_verb(verb);
    }
    return text + zsh_tail;
}

}  // namespace coagula::tools
