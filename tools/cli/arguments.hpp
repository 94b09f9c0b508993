// The command line of a verb, parsed by its table of options.
#pragma once

#include "option.hpp"

#include <coagula/common/checks.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace coagula::tools {

/// The values of all options of one call: parsed, in SI units and within their ranges.
class Arguments {
public:
    /// Throws InputError with a sentence that names the option and the rule.
    /// @param typed what follows the verb on the command line.
    Arguments(const Verb& verb, const std::vector<std::string>& typed);

    bool help_wanted() const { return help_wanted_; }
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
            throw InputError("--" + name + ": " + error.what());
        }
    }
    const std::string& input() const { return text("input"); }
    /// Of a verb that takes many, in the order given; also where one is given.
    std::vector<std::string> inputs() const;

    /// The files that the call reads, or those that it writes.
    std::vector<std::string> files(Option::File use) const;

    const std::string& verb() const { return verb_; }
    /// As it could be typed again.
    const std::string& command_line() const { return command_line_; }
    /// All options with their values, for the provenance.
    nlohmann::ordered_json to_json() const;

private:
    using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

    void store(const Option& option, const std::string& word);
    bool holds(const Condition& condition) const;
    void check_conditions(const std::vector<Option>& options) const;

    std::string verb_;
    std::string command_line_;
    std::map<std::string, Value> values_;
    std::set<std::string> given_;
    std::map<std::string, Option::File> files_;  ///< options that name files
    bool help_wanted_ = false;
};

/// A quantity in `unit` from a text, such as one of a list. Throws InputError unless it is within the range, and for a length above
/// `largest_bare` without a unit.
double parse_quantity(const std::string& word, const std::string& unit, const Range& range,
                      double largest_bare = std::numeric_limits<double>::infinity());

/// The parts of a list "a,b,c".
std::vector<std::string> split(const std::string& list, char separator = ',');

}  // namespace coagula::tools
