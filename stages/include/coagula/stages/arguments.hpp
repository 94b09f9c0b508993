// SPDX-License-Identifier: GPL-3.0-or-later
// The values of a verb's options in one call, read by its table: from the words of a command line, from TOML and from Python alike.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/stages/option.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace coagula::stages {

/// A value as the caller has it: a word of a command line is a text, a number of TOML or Python stays one.
using GivenItem = std::variant<std::int64_t, double, std::string>;
using Given = std::variant<bool, std::int64_t, double, std::string, std::vector<GivenItem>>;

/// Who calls. Sentences name an option as the caller spells it: --stop-time, stop_time or stop-time.
enum class Caller { program, python, file };

struct Call {
    std::map<std::string, Given> values;  ///< by the name of the option; "input" is the argument without a name
    std::string text = {};                ///< as the call could be made again, for the history of a file
    Caller caller = Caller::program;
};

/// "--stop-time", "stop_time" or "stop-time".
std::string spelled(Caller caller, const std::string& option);
/// "--method dem", "method='dem'" or "method = "dem"".
std::string spelled(Caller caller, const std::string& option, const std::string& value);

/// The values of all options of one call: in SI units and within their ranges.
class Arguments {
public:
    /// Throws InputError with a sentence that names the option and the rule.
    Arguments(const Verb& verb, const Call& call);

    /// Whether the option has a value, given or default.
    bool has(const std::string& name) const { return values_.contains(name); }
    bool flag(const std::string& name) const { return has(name); }
    /// Whether the option was given.
    bool given(const std::string& name) const { return given_.contains(name); }
    std::int64_t count(const std::string& name) const;
    double quantity(const std::string& name) const;
    std::optional<double> optional_quantity(const std::string& name) const;
    const std::string& text(const std::string& name) const;
    /// The text of an option, or `otherwise` when it was not given.
    std::string text(const std::string& name, const std::string& otherwise) const;
    /// What `parse` makes of the text of an option; its InputError then names the option.
    template <class Parse>
    auto parsed(const std::string& name, const Parse& parse) const {
        try {
            return parse(text(name));
        } catch (const InputError& error) {
            throw InputError(spelled(name) + ": " + error.what());
        }
    }
    const std::string& input() const { return text("input"); }
    /// The inputs of a verb that takes many, in the order given; also where one is given.
    std::vector<std::string> inputs() const;

    /// The files that the call reads, or those that it writes.
    std::vector<std::string> files(Option::File use) const;

    /// The same call with another value of a count.
    Arguments with_count(const std::string& name, std::int64_t value) const;
    /// The same call with another value of a quantity.
    Arguments with_quantity(const std::string& name, double value) const;

    const std::string& verb() const { return verb_; }
    /// The verb as the caller names it: "coagula generate vem", "generate_vem()" or "generate vem".
    std::string caller_of() const;
    /// The name of an option as the caller spells it.
    std::string spelled(const std::string& option) const { return stages::spelled(caller_, option); }
    std::string spelled(const std::string& option, const std::string& value) const {
        return stages::spelled(caller_, option, value);
    }
    /// " (see 'coagula generate vem --help')".
    std::string hint() const;
    /// The call as it could be made again.
    const std::string& call() const { return call_; }
    /// All options with their values, for the provenance.
    nlohmann::ordered_json to_json() const;

private:
    using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

    void read(const Option& option, const Verb& verb, const Call& call);
    bool holds(const Condition& condition) const;
    void check_conditions(const std::vector<Option>& options) const;

    std::string verb_;
    std::string call_;
    Caller caller_;
    std::map<std::string, Value> values_;
    std::set<std::string> given_;
    std::map<std::string, Option::File> files_;  ///< options that name files
};

/// A quantity in `unit` from a text, such as one of a list. Throws InputError unless it is within the range, and for a length above
/// `largest_bare` without a unit.
double parse_quantity(const std::string& word, const std::string& unit, const Range& range,
                      double largest_bare = std::numeric_limits<double>::infinity());

/// The parts of a list "a,b,c".
std::vector<std::string> split(const std::string& list, char separator = ',');

/// Whether the text is a number and nothing else.
bool is_bare_number(const std::string& word);

/// The value of a text with a unit; "4GB" are bytes. Throws InputError.
double parse_with_unit(std::string word, const std::string& unit);

}  // namespace coagula::stages
