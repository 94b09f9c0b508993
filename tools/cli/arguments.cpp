#include "arguments.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/units.hpp>
#include <coagula/report/printable.hpp>

#include <boost/program_options.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace coagula::tools {

namespace {

namespace po = boost::program_options;

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

po::variables_map read_words(const Verb& verb, const std::vector<Option>& options, const std::vector<std::string>& words,
                             bool many_inputs) {
    po::options_description description;
    for (const Option& option : options) {
        const std::string names = option.letter != 0 ? option.name + "," + option.letter : option.name;
        if (option.kind == Option::Kind::flag) {
            description.add_options()(names.c_str(), "");
        } else if (many_inputs && option.name == "input") {
            description.add_options()(names.c_str(), po::value<std::vector<std::string>>(), "");
        } else {
            description.add_options()(names.c_str(), po::value<std::string>(), "");
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

std::int64_t parse_count(const std::string& word) {
    const char* last = word.data() + word.size();
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), last, value);
    if (error == std::errc{} && end == last) {
        return value;
    }
    double number = 0;  // such as 1e6; every whole number up to 2^53 is a double
    const auto [number_end, number_error] = std::from_chars(word.data(), last, number);
    const bool whole = number_error == std::errc{} && number_end == last && number == std::nearbyint(number);
    if (whole && std::abs(number) <= 9007199254740992.0) {
        return static_cast<std::int64_t>(number);
    }
    const bool too_large = error == std::errc::result_out_of_range || whole;
    throw InputError("'" + word + "' is not a whole number" + (too_large ? " that the program can hold" : ""));
}

/// UDUNITS knows bytes under their full name only.
double any_quantity(std::string word, const std::string& unit) {
    if (unit == "byte" && word.ends_with('B')) {
        word.replace(word.size() - 1, 1, "byte");
    }
    return io::parse_quantity(word, unit);
}

void check_range(const Range& range, const std::string& unit, double value, const std::string& word) {
    if (!range.holds(value)) {
        throw InputError("'" + word + "' is out of range: must be " + range.text() +
                         (unit.empty() || unit == "1" ? "" : " " + unit));
    }
}

/// Whether the text is a number and nothing else.
bool is_bare(const std::string& word) {
    return word.find_first_not_of("+-.0123456789eE \t") == std::string::npos;
}

/// The one word of an option, or the first of those that were given.
std::string word_of(const po::variable_value& value) {
    const auto* many = boost::any_cast<std::vector<std::string>>(&value.value());
    return many != nullptr ? many->front() : value.as<std::string>();
}

/// Puts together what the shell took apart: "--ionic-strength 10 mM" as "--ionic-strength '10 mM'". A word that is no unit of the
/// option's dimension, or the name of a file that exists, stays by itself.
std::vector<std::string> with_units_joined(const std::vector<Option>& options, const std::vector<std::string>& words) {
    std::vector<std::string> joined;
    const auto is_unit_of_last = [&](const std::string& word) {
        if (joined.size() < 2 || !is_bare(joined.back()) || word.empty() || word.starts_with('-') || is_bare(word)) {
            return false;
        }
        const auto option = std::find_if(options.begin(), options.end(), [&](const Option& entry) {
            return entry.kind == Option::Kind::quantity && joined[joined.size() - 2] == "--" + entry.name;
        });
        try {
            return option != options.end() && std::isfinite(any_quantity(joined.back() + ' ' + word, option->unit)) &&
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

/// "--method quasistatic or dem".
std::string as_typed(const Condition& condition) {
    std::string text = "--" + condition.option;
    for (std::size_t k = 0; k < condition.values.size(); ++k) {
        text += (k == 0 ? " " : " or ") + condition.values[k];
    }
    return text;
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

}  // namespace

Arguments::Arguments(const Verb& verb, const std::vector<std::string>& typed) : verb_(verb.name) {
    const std::vector<Option> options = all_options(verb);
    const std::vector<std::string> words = with_units_joined(options, typed);
    command_line_ = "coagula " + verb.name;
    for (const std::string& word : words) {
        if (!report::is_utf8(word)) {
            throw InputError("'" + word + "' is not UTF-8 text, which every option and every name of a file must be");
        }
        command_line_ += ' ' + quoted(word);
    }
    const bool many_inputs = takes_many(verb, words);
    const po::variables_map map = read_words(verb, options, words, many_inputs);
    if (map.count("help") > 0) {
        help_wanted_ = true;
        return;
    }
    for (const Option& option : options) {
        const std::string name = option.name == "input" ? verb.input : "--" + option.name;
        const bool given = map.count(option.name) > 0;
        const bool spared = option.name == "input" && !verb.alone.empty() && map.count(verb.alone) > 0;
        if (!given && option.required && !spared) {
            throw InputError("coagula " + verb.name + " needs " + name + hint(verb.name));
        }
        if (!given && option.fallback.empty()) {
            continue;
        }
        if (given) {
            given_.insert(option.name);
        }
        if (option.file != Option::File::none) {
            files_[option.name] = option.file;
        }
        if (many_inputs && option.name == "input" && map["input"].as<std::vector<std::string>>().size() > 1) {
            values_["input"] = map["input"].as<std::vector<std::string>>();
            continue;
        }
        const bool is_flag = option.kind == Option::Kind::flag;
        try {
            store(option, is_flag ? "" : (given ? word_of(map[option.name]) : option.fallback));
        } catch (const InputError& error) {
            throw InputError(name + ": " + error.what() + hint(verb.name));
        }
    }
    check_conditions(options);
}

bool Arguments::holds(const Condition& condition) const {
    const bool any = condition.values.empty();
    return any ? given(condition.option)
               : has(condition.option) && std::ranges::count(condition.values, text(condition.option)) > 0;
}

/// An option that nobody reads would be taken for one that had an effect.
void Arguments::check_conditions(const std::vector<Option>& options) const {
    for (const Option& option : options) {
        for (const Condition& condition : option.conditions) {
            if (given(option.name) && holds(condition) != condition.wanted) {
                throw InputError("--" + option.name + " is " + (condition.wanted ? "read only" : "not read") + " with " +
                                 as_typed(condition) + hint(verb_));
            }
        }
    }
}

void Arguments::store(const Option& option, const std::string& word) {
    switch (option.kind) {
        case Option::Kind::flag:
            values_[option.name] = true;
            return;
        case Option::Kind::count: {
            const std::int64_t value = parse_count(word);
            check_range(option.range, "", static_cast<double>(value), word);
            values_[option.name] = value;
            return;
        }
        case Option::Kind::quantity: {
            values_[option.name] = parse_quantity(word, option.unit, option.range, option.largest_bare);
            return;
        }
        case Option::Kind::text:
            break;
    }
    if (word.empty()) {
        throw InputError("the value is empty");
    }
    if (!option.choices.empty() && std::find(option.choices.begin(), option.choices.end(), word) == option.choices.end()) {
        throw InputError("'" + word + "' is not one of " + list_of(option.choices) + did_you_mean(word, option.choices));
    }
    values_[option.name] = word;
}

std::int64_t Arguments::count(const std::string& name) const {
    return std::get<std::int64_t>(values_.at(name));
}

double Arguments::quantity(const std::string& name) const {
    return std::get<double>(values_.at(name));
}

std::optional<double> Arguments::optional_quantity(const std::string& name) const {
    return has(name) ? std::optional(quantity(name)) : std::nullopt;
}

const std::string& Arguments::text(const std::string& name) const {
    return std::get<std::string>(values_.at(name));
}

std::vector<std::string> Arguments::inputs() const {
    const Value& value = values_.at("input");
    const auto* many = std::get_if<std::vector<std::string>>(&value);
    return many != nullptr ? *many : std::vector<std::string>{std::get<std::string>(value)};
}

std::vector<std::string> Arguments::files(Option::File use) const {
    std::vector<std::string> names;
    for (const auto& [option, what] : files_) {
        if (what == use) {
            const std::vector<std::string> given = option == "input" ? inputs() : std::vector{text(option)};
            names.insert(names.end(), given.begin(), given.end());
        }
    }
    return names;
}

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
    return has(name) ? text(name) : otherwise;
}

nlohmann::ordered_json Arguments::to_json() const {
    auto json = nlohmann::ordered_json::object();
    for (const auto& [name, value] : values_) {
        std::visit([&json, key = name](const auto& content) { json[key] = content; }, value);
    }
    return json;
}

double parse_quantity(const std::string& word, const std::string& unit, const Range& range, double largest_bare) {
    const double value = any_quantity(word, unit);
    if (value > largest_bare && is_bare(word)) {
        throw InputError("'" + word + "' has no unit and would be " + to_text(value) + " " + unit +
                         ": give it with its unit, such as " + word + "um or " + word + unit);
    }
    check_range(range, unit, value, word);
    return value;
}

std::vector<std::string> split(const std::string& list, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, separator);) {
        parts.push_back(part);
    }
    return parts;
}

}  // namespace coagula::tools
