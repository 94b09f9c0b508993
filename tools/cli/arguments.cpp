#include "arguments.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/units.hpp>
#include <coagula/report/printable.hpp>

#include <boost/program_options.hpp>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace coagula::tools {

namespace {

namespace po = boost::program_options;

/// What every verb understands.
std::vector<Option> common_options() {
    Option help = flag("help", "print this text");
    help.letter = 'h';
    return {flag("json", "print one JSON object and nothing else on standard output"),
            count("threads", "number of threads; all cores when not given", "", within(1, 4096)),
            flag("quiet", "no progress bar and no table"), help};
}

std::vector<Option> all_options(const Verb& verb) {
    std::vector<Option> options;
    if (!verb.input.empty()) {
        Option input = text("input", verb.input, "the file to work on");
        input.required = true;
        options.push_back(input);
    }
    options.insert(options.end(), verb.options.begin(), verb.options.end());
    for (Option& option : common_options()) {
        options.push_back(std::move(option));
    }
    return options;
}

std::string hint(const std::string& verb) {
    return " (see 'coagula " + verb + " --help')";
}

/// Whether several arguments without a name may be given in this call.
bool takes_many(const Verb& verb, const std::vector<std::string>& words) {
    const bool beside = !verb.many_beside.empty() && std::find(words.begin(), words.end(), "--" + verb.many_beside) != words.end();
    return verb.many_inputs || beside;
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
                         " besides its options" + hint(verb.name));
    } catch (const po::error& error) {
        throw InputError(error.what() + hint(verb.name));
    }
    return map;
}

std::int64_t parse_count(const std::string& word) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size()) {
        throw InputError("'" + word + "' is not a whole number" +
                         (error == std::errc::result_out_of_range ? " that the program can hold" : ""));
    }
    return value;
}

/// UDUNITS knows bytes under their full name only.
double parse_bytes(std::string word) {
    if (word.ends_with('B')) {
        word.replace(word.size() - 1, 1, "byte");
    }
    return io::parse_quantity(word, "byte");
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

std::string left_column(const Option& option) {
    std::string text = option.letter != 0 ? std::string("  -") + option.letter + ", --" : std::string("      --");
    text += option.name;
    return option.kind == Option::Kind::flag ? text : text + " " + option.placeholder;
}

/// Unit, default and range in brackets.
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

}  // namespace

bool Range::holds(double value) const {
    return ends_included ? value >= low && value <= high : value > low && value < high;
}

std::string Range::text() const {
    const bool has_low = std::isfinite(low);
    const bool has_high = std::isfinite(high);
    const std::string equal = ends_included ? "= " : " ";
    if (has_low && has_high) {
        return ends_included ? to_text(low) + " .. " + to_text(high) : "> " + to_text(low) + " and < " + to_text(high);
    }
    return has_low ? ">" + equal + to_text(low) : (has_high ? "<" + equal + to_text(high) : "");
}

Range at_least(double low) {
    return {.low = low};
}

Range above(double low) {
    return {.low = low, .ends_included = false};
}

Range between(double low, double high) {
    return {.low = low, .high = high, .ends_included = false};
}

Range within(double low, double high) {
    return {.low = low, .high = high};
}

Option flag(std::string name, std::string meaning) {
    return {.kind = Option::Kind::flag, .name = std::move(name), .meaning = std::move(meaning)};
}

Option count(std::string name, std::string meaning, std::string fallback, Range range) {
    return {.kind = Option::Kind::count,
            .name = std::move(name),
            .placeholder = "N",
            .meaning = std::move(meaning),
            .fallback = std::move(fallback),
            .range = range};
}

Option quantity(std::string name, std::string unit, std::string meaning, std::string fallback, Range range) {
    return {.kind = Option::Kind::quantity,
            .name = std::move(name),
            .placeholder = "X",
            .meaning = std::move(meaning),
            .unit = std::move(unit),
            .fallback = std::move(fallback),
            .range = range};
}

Option particle_radius(std::string meaning) {
    Option option = quantity("radius", "m", std::move(meaning), "", physical::length);
    option.largest_bare = 0.1;
    return option;
}

Option text(std::string name, std::string placeholder, std::string meaning, std::string fallback) {
    return {.kind = Option::Kind::text,
            .name = std::move(name),
            .placeholder = std::move(placeholder),
            .meaning = std::move(meaning),
            .fallback = std::move(fallback)};
}

Option choice(std::string name, std::vector<std::string> choices, std::string meaning, std::string fallback) {
    Option option = text(std::move(name), "NAME", std::move(meaning), std::move(fallback));
    option.choices = std::move(choices);
    return option;
}

Option required(Option option) {
    option.required = true;
    return option;
}

Option output(std::string meaning) {
    Option option = text("output", "FILE", std::move(meaning));
    option.letter = 'o';
    return option;
}

Arguments::Arguments(const Verb& verb, const std::vector<std::string>& words) : verb_(verb.name) {
    command_line_ = "coagula " + verb.name;
    for (const std::string& word : words) {
        if (!report::is_utf8(word)) {
            throw InputError("'" + word + "' is not UTF-8 text, which every option and every name of a file must be");
        }
        command_line_ += ' ' + quoted(word);
    }
    const std::vector<Option> options = all_options(verb);
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
        std::string list;
        for (const std::string& name : option.choices) {
            list += (list.empty() ? "" : ", ") + name;
        }
        throw InputError("'" + word + "' is not one of " + list);
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

double parse_quantity(const std::string& word, const std::string& unit, const Range& range, double largest_bare) {
    const double value = unit == "byte" ? parse_bytes(word) : io::parse_quantity(word, unit);
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
