// SPDX-License-Identifier: GPL-3.0-or-later
#include "command_line.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/printable.hpp>

#include <boost/program_options.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace coagula::tools {

namespace {

namespace po = boost::program_options;
using stages::Option;
using stages::Verb;

std::string hint(const std::string& verb) {
    return " (see 'coagula " + verb + " --help')";
}

/// Whether several arguments without a name may be given in this call.
bool takes_many(const Verb& verb, const std::vector<std::string>& words) {
    const bool beside = !verb.many_beside.empty() && std::find(words.begin(), words.end(), "--" + verb.many_beside) != words.end();
    return verb.many_inputs || beside;
}

/// The end of the sentence about an option that does not exist.
std::string meant_option(const std::string& written, const std::vector<Option>& options) {
    std::vector<std::string> names;
    for (const Option& option : options) {
        if (option.name != "input") {
            names.push_back(option.name);
        }
    }
    const std::size_t begin = written.find_first_not_of('-');
    return begin == std::string::npos ? std::string{} : did_you_mean(written.substr(begin), names, "--");
}

void describe(po::options_description& description, const Option& option, const std::string& names, bool many) {
    if (option.kind == Option::Kind::flag) {
        description.add_options()(names.c_str(), "");
    } else if (many) {
        description.add_options()(names.c_str(), po::value<std::vector<std::string>>(), "");
    } else {
        description.add_options()(names.c_str(), po::value<std::string>(), "");
    }
}

po::variables_map read_words(const Verb& verb, const std::vector<Option>& options, const std::vector<std::string>& words,
                             bool many_inputs) {
    po::options_description description;
    for (const Option& option : options) {
        const std::string names = option.letter != 0 ? option.name + "," + option.letter : option.name;
        describe(description, option, names, many_inputs && option.name == "input");
        if (!option.former_name.empty()) {
            describe(description, option, option.former_name, false);
        }
    }
    po::positional_options_description positional;
    if (!verb.input.empty()) {
        positional.add("input", many_inputs ? -1 : 1);
    }
    namespace style = po::command_line_style;
    po::variables_map map;
    try {
        po::store(po::command_line_parser(words)
                      .options(description)
                      .positional(positional)
                      .style(style::unix_style & ~style::allow_guessing)
                      .run(),
                  map);
    } catch (const po::too_many_positional_options_error&) {
        throw InputError("coagula " + verb.name + (verb.input.empty() ? " takes no argument" : " takes one " + verb.input) +
                         " besides its options" + (verb.many_beside.empty() ? "" : ", several only with --" + verb.many_beside) +
                         hint(verb.name));
    } catch (const po::unknown_option& error) {
        throw InputError("there is no option '" + error.get_option_name() + "'" + meant_option(error.get_option_name(), options) +
                         hint(verb.name));
    } catch (const po::error& error) {
        throw InputError(error.what() + hint(verb.name));
    }
    return map;
}

/// Puts together what the shell took apart: "--ionic-strength 10 mM" as "--ionic-strength '10 mM'". A word that is no unit of the
/// option's dimension, or the name of a file that exists, stays by itself.
std::vector<std::string> with_units_joined(const std::vector<Option>& options, const std::vector<std::string>& words) {
    std::vector<std::string> joined;
    const auto is_unit_of_last = [&](const std::string& word) {
        if (joined.size() < 2 || !stages::is_bare_number(joined.back()) || word.empty() || word.starts_with('-') ||
            stages::is_bare_number(word)) {
            return false;
        }
        const std::string& before = joined[joined.size() - 2];
        const auto option = std::find_if(options.begin(), options.end(), [&](const Option& entry) {
            return entry.kind == Option::Kind::quantity && before.starts_with("--") && entry.goes_by(before.substr(2));
        });
        try {
            return option != options.end() && std::isfinite(stages::parse_with_unit(joined.back() + ' ' + word, option->unit)) &&
                   !std::filesystem::exists(word);
        } catch (const InputError&) {
            return false;
        }
    };
    for (const std::string& word : words) {
        if (is_unit_of_last(word)) {
            joined.back() += ' ' + word;
        } else {
            joined.push_back(word);
        }
    }
    return joined;
}

/// A word as a shell would have to read it.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || std::string_view("-_./:,=+%@").find(static_cast<char>(c)) != std::string_view::npos;
    });
    if (plain) {
        return word;
    }
    std::string text = "'";
    for (const char c : word) {
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return text + "'";
}

stages::Given given_of(const Option& option, const po::variable_value& value) {
    if (option.kind == Option::Kind::flag) {
        return true;
    }
    const auto* many = boost::any_cast<std::vector<std::string>>(&value.value());
    if (many == nullptr) {
        return value.as<std::string>();
    }
    if (many->size() == 1) {
        return many->front();
    }
    return std::vector<stages::GivenItem>(many->begin(), many->end());
}

}  // namespace

CommandLine read_command_line(const Verb& verb, const std::vector<std::string>& typed) {
    const std::vector<Option> options = all_options(verb);
    const std::vector<std::string> words = with_units_joined(options, typed);
    CommandLine line;
    line.call.text = "coagula " + verb.name;
    for (const std::string& word : words) {
        if (!io::is_utf8(word)) {
            throw InputError("'" + word + "' is not UTF-8 text, which every option and every name of a file must be");
        }
        line.call.text += ' ' + quoted(word);
    }
    const po::variables_map map = read_words(verb, options, words, takes_many(verb, words));
    line.help_wanted = map.count("help") > 0;
    for (const Option& option : options) {
        const bool now = map.count(option.name) > 0;
        const bool old = !option.former_name.empty() && map.count(option.former_name) > 0;
        if (now && old) {
            throw InputError("--" + option.former_name + " is the old name of --" + option.name + ": give one of them" +
                             hint(verb.name));
        }
        if (old) {
            line.notes.push_back("--" + option.former_name + " is called --" + option.name +
                                 " now; the old name works until version 2");
        }
        if (now || old) {
            line.call.values[option.name] = given_of(option, map[now ? option.name : option.former_name]);
        }
    }
    return line;
}

}  // namespace coagula::tools
