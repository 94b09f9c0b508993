// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>
#include <coagula/stages/option.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

/// What every verb understands.
std::vector<Option> common_options() {
    Option help = flag("help", "print this text");
    help.letter = 'h';
    return {flag("json", "print one JSON object and nothing else on standard output"),
            count("threads", "number of threads, at most one for each processor, which is also the default", "", within(1, 4096)),
            flag("quiet", "no progress bar and no table"), help};
}

void add_condition(std::vector<Option>& options, const std::vector<std::string>& names, const Condition& condition) {
    for (Option& option : options) {
        if (std::find(names.begin(), names.end(), option.name) != names.end()) {
            option.conditions.push_back(condition);
        }
    }
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

Option formerly(std::string name, Option option) {
    option.former_name = std::move(name);
    return option;
}

Option reads(Option option) {
    option.file = Option::File::read;
    return option;
}

Option writes(Option option) {
    option.file = Option::File::written;
    return option;
}

Option output(std::string meaning) {
    Option option = writes(text("output", "FILE", std::move(meaning)));
    option.letter = 'o';
    return option;
}

void read_only_with(std::vector<Option>& options, const std::vector<std::string>& names, const std::string& other,
                    const std::vector<std::string>& values) {
    add_condition(options, names, {other, values, true});
}

void not_read_with(std::vector<Option>& options, const std::vector<std::string>& names, const std::string& other,
                   const std::vector<std::string>& values) {
    add_condition(options, names, {other, values, false});
}

Verb in_memory(Verb verb, const std::set<std::string>& without) {
    verb.input.clear();
    verb.many_inputs = false;
    std::erase_if(verb.options, [&](const Option& option) {
        return option.name == "output" || option.name == "force" || without.contains(option.name);
    });
    return verb;
}

std::vector<Option> all_options(const Verb& verb) {
    std::vector<Option> options;
    if (!verb.input.empty()) {
        Option input = reads(text("input", verb.input, "the file to work on"));
        input.required = verb.input_required;
        input.choices = verb.input_choices;
        options.push_back(input);
    }
    options.insert(options.end(), verb.options.begin(), verb.options.end());
    for (Option& option : common_options()) {
        options.push_back(std::move(option));
    }
    return options;
}

}  // namespace coagula::stages
