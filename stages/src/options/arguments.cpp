// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/spelling.hpp>
#include <coagula/io/printable.hpp>
#include <coagula/io/units.hpp>
#include <coagula/stages/arguments.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace coagula::stages {

namespace {

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

void check_range(const Range& range, const std::string& unit, double value, const std::string& word) {
    if (!range.holds(value)) {
        throw InputError("'" + word + "' is out of range: must be " + range.text() +
                         (unit.empty() || unit == "1" ? "" : " " + unit));
    }
}

/// A number without a unit that would be a longer length than anybody means.
void check_bare(double value, const std::string& word, const std::string& unit, double largest_bare) {
    if (value > largest_bare) {
        throw InputError("'" + word + "' has no unit and would be " + to_text(value) + " " + unit +
                         ": give it with its unit, such as " + word + "um or " + word + unit);
    }
}

std::string text_of(const GivenItem& item) {
    if (const auto* whole = std::get_if<std::int64_t>(&item)) {
        return std::to_string(*whole);
    }
    const auto* number = std::get_if<double>(&item);
    return number != nullptr ? to_text(*number) : std::get<std::string>(item);
}

/// The value as a text: of a list "a,b,c".
std::string text_of(const Given& given) {
    if (const auto* list = std::get_if<std::vector<GivenItem>>(&given)) {
        std::string text;
        for (const GivenItem& item : *list) {
            text += (text.empty() ? "" : ",") + text_of(item);
        }
        return text;
    }
    if (const auto* truth = std::get_if<bool>(&given)) {
        return *truth ? "true" : "false";
    }
    if (const auto* whole = std::get_if<std::int64_t>(&given)) {
        return std::to_string(*whole);
    }
    const auto* number = std::get_if<double>(&given);
    return number != nullptr ? to_text(*number) : std::get<std::string>(given);
}

std::optional<double> number_of(const Given& given) {
    if (const auto* whole = std::get_if<std::int64_t>(&given)) {
        return static_cast<double>(*whole);
    }
    const auto* number = std::get_if<double>(&given);
    return number != nullptr ? std::optional(*number) : std::nullopt;
}

std::int64_t count_of(const Option& option, const Given& given) {
    const auto* whole = std::get_if<std::int64_t>(&given);
    const std::int64_t value = whole != nullptr ? *whole : parse_count(text_of(given));
    check_range(option.range, "", static_cast<double>(value), text_of(given));
    return value;
}

double quantity_of(const Option& option, const Given& given) {
    if (const std::optional<double> value = number_of(given)) {
        check_bare(*value, text_of(given), option.unit, option.largest_bare);
        check_range(option.range, option.unit, *value, text_of(given));
        return *value;
    }
    return parse_quantity(text_of(given), option.unit, option.range, option.largest_bare);
}

std::string text_value_of(const Option& option, const Given& given) {
    std::string text = text_of(given);
    if (text.empty()) {
        throw InputError("the value is empty");
    }
    if (!io::is_utf8(text)) {
        throw InputError("'" + text + "' is not UTF-8 text, which every option and every name of a file must be");
    }
    if (!option.choices.empty() && std::find(option.choices.begin(), option.choices.end(), text) == option.choices.end()) {
        throw InputError("'" + text + "' is not one of " + list_of(option.choices) + did_you_mean(text, option.choices));
    }
    return text;
}

std::string in_python(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
    return name == "from" || name == "import" ? name + "_" : name;  // words of the language
}

/// "--method quasistatic or dem".
std::string as_given(Caller caller, const Condition& condition) {
    if (condition.values.empty()) {
        return spelled(caller, condition.option);
    }
    std::string text = spelled(caller, condition.option, condition.values.front());
    for (std::size_t k = 1; k < condition.values.size(); ++k) {
        text += " or " + condition.values[k];
    }
    return text;
}

}  // namespace

std::string spelled(Caller caller, const std::string& option) {
    return caller == Caller::program ? "--" + option : caller == Caller::python ? in_python(option) : option;
}

std::string spelled(Caller caller, const std::string& option, const std::string& value) {
    return caller == Caller::program  ? "--" + option + " " + value
           : caller == Caller::python ? in_python(option) + "='" + value + "'"
                                      : option + " = \"" + value + "\"";
}

Arguments::Arguments(const Verb& verb, const Call& call) : verb_(verb.name), call_(call.text), caller_(call.caller) {
    const std::vector<Option> options = all_options(verb);
    for (const Option& option : options) {
        read(option, verb, call);
    }
    check_conditions(options);
}

void Arguments::read(const Option& option, const Verb& verb, const Call& call) {
    const std::string name = option.name == "input" ? verb.input : spelled(option.name);
    const auto place = call.values.find(option.name);
    const bool off = place != call.values.end() && option.kind == Option::Kind::flag && place->second == Given(false);
    const bool is_given = place != call.values.end() && !off;
    const bool spared = option.name == "input" && !verb.alone.empty() && call.values.contains(verb.alone);
    if (!is_given && option.required && !spared) {
        throw InputError(caller_of() + " needs " + name + hint());
    }
    if (!is_given && option.fallback.empty()) {
        return;
    }
    if (is_given) {
        given_.insert(option.name);
    }
    if (option.file != Option::File::none) {
        files_[option.name] = option.file;
    }
    const Given& value = is_given ? place->second : Given(option.fallback);
    try {
        if (option.name == "input" && std::holds_alternative<std::vector<GivenItem>>(value)) {
            std::vector<std::string> inputs;
            for (const GivenItem& item : std::get<std::vector<GivenItem>>(value)) {
                inputs.push_back(text_value_of(option, std::visit([](const auto& part) { return Given(part); }, item)));
            }
            values_[option.name] = std::move(inputs);
            return;
        }
        switch (option.kind) {
            case Option::Kind::flag:
                if (value != Given(true)) {
                    throw InputError("'" + text_of(value) + "' is neither true nor false");
                }
                values_[option.name] = true;
                break;
            case Option::Kind::count:
                values_[option.name] = count_of(option, value);
                break;
            case Option::Kind::quantity:
                values_[option.name] = quantity_of(option, value);
                break;
            case Option::Kind::text:
                values_[option.name] = text_value_of(option, value);
                break;
        }
    } catch (const InputError& error) {
        throw InputError(name + ": " + error.what() + hint());
    }
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
                throw InputError(spelled(option.name) + " is " + (condition.wanted ? "read only" : "not read") + " with " +
                                 as_given(caller_, condition) + hint());
            }
        }
    }
}

std::string Arguments::caller_of() const {
    return caller_ == Caller::program ? "coagula " + verb_ : caller_ == Caller::python ? in_python(verb_) + "()" : verb_;
}

std::string Arguments::hint() const {
    return caller_ == Caller::python ? " (see help(coagula." + in_python(verb_) + "))" : " (see 'coagula " + verb_ + " --help')";
}

std::int64_t Arguments::count(const std::string& name) const {
    return std::get<std::int64_t>(values_.at(name));
}

Arguments Arguments::with_count(const std::string& name, std::int64_t value) const {
    Arguments changed = *this;
    changed.values_[name] = value;
    return changed;
}

Arguments Arguments::with_quantity(const std::string& name, double value) const {
    Arguments changed = *this;
    changed.values_[name] = value;
    return changed;
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
    const double value = parse_with_unit(word, unit);
    if (is_bare_number(word)) {
        check_bare(value, word, unit, largest_bare);
    }
    check_range(range, unit, value, word);
    return value;
}

bool is_bare_number(const std::string& word) {
    return word.find_first_not_of("+-.0123456789eE \t") == std::string::npos;
}

/// UDUNITS knows bytes under their full name only.
double parse_with_unit(std::string word, const std::string& unit) {
    if (unit == "byte" && word.ends_with('B')) {
        word.replace(word.size() - 1, 1, "byte");
    }
    return io::parse_quantity(word, unit);
}

std::vector<std::string> split(const std::string& list, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(list);
    for (std::string part; std::getline(stream, part, separator);) {
        parts.push_back(part);
    }
    return parts;
}

}  // namespace coagula::stages
