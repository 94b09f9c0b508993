// SPDX-License-Identifier: GPL-3.0-or-later
#include "axis.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

constexpr std::int64_t most_steps = 1000000;

/// Reads the value of one option and names it in sentences.
class AxisReader {
public:
    AxisReader(const Option& option, const std::string& where, bool stepped) : option_(option), where_(where), stepped_(stepped) {}

    Axis read(const toml::node& node) const {
        if (const auto* list = node.as_array()) {
            return {option_.name, list_values(*list)};
        }
        if (const auto* table = node.as_table()) {
            return range_values(*table);
        }
        return {option_.name, {value(node)}};
    }

private:
    [[noreturn]] void fail(const std::string& rule) const { throw InputError(where_ + ", key '" + option_.name + "': " + rule); }

    Given value(const toml::node& node) const {
        if (const auto flag = node.as_boolean()) {
            return flag->get();
        }
        if (const auto whole = node.as_integer()) {
            return std::int64_t{whole->get()};
        }
        if (const auto number = node.as_floating_point()) {
            if (!std::isfinite(number->get())) {
                fail("must be finite");
            }
            return number->get();
        }
        if (const auto text = node.as_string()) {
            return text->get();
        }
        fail("must be a number, a text, true or false, a list of these, or a range { from, to, steps }");
    }

    std::vector<Given> list_values(const toml::array& list) const {
        std::vector<Given> values;
        for (const toml::node& node : list) {
            const Given next = value(node);
            if (std::find(values.begin(), values.end(), next) != values.end()) {
                fail("has the same value twice");
            }
            values.push_back(next);
        }
        if (values.empty()) {
            fail("is an empty list: give at least one value");
        }
        return values;
    }

    double end(const toml::table& table, const char* name) const {
        const toml::node* node = table.get(name);
        if (node == nullptr) {
            fail(std::string("is a range without '") + name + "'");
        }
        if (node->is_number()) {
            const double number = *node->value<double>();
            return std::isfinite(number) ? number : (fail(std::string("'") + name + "' must be finite"), 0.0);
        }
        if (!node->is_string()) {
            fail(std::string("'") + name + "' must be a number, or a text with a unit");
        }
        try {
            return parse_with_unit(node->ref<std::string>(), option_.unit.empty() ? "1" : option_.unit);
        } catch (const InputError& error) {
            fail(error.what());
        }
    }

    bool is_logarithmic(const toml::table& table) const {
        const toml::node* node = table.get("scale");
        if (node == nullptr) {
            return false;
        }
        const std::string scale = node->is_string() ? node->ref<std::string>() : std::string{};
        if (scale != "log" && scale != "linear") {
            fail("'scale' must be \"linear\" or \"log\"");
        }
        return scale == "log";
    }

    std::int64_t steps(const toml::table& table) const {
        const toml::node* node = table.get("steps");
        const auto* number = node == nullptr ? nullptr : node->as_integer();
        if (number == nullptr || number->get() < 2 || number->get() > most_steps) {
            fail("is a range that needs 'steps', a whole number from 2 to " + std::to_string(most_steps));
        }
        return number->get();
    }

    Axis range_values(const toml::table& table) const {
        if (option_.kind == Option::Kind::text || option_.kind == Option::Kind::flag) {
            fail("takes no range, because its values are no numbers: give a list");
        }
        const std::vector<std::string> known = {"from", "to", "steps", "scale"};
        for (const auto& [key, node] : table) {
            const std::string name(key.str());
            if (std::find(known.begin(), known.end(), name) == known.end()) {
                fail("has a range with the unknown key '" + name + "'" + did_you_mean(name, known));
            }
        }
        const OpenRange range{end(table, "from"), end(table, "to"), is_logarithmic(table), option_.kind == Option::Kind::count};
        if (!(range.from < range.to)) {
            fail("is a range from " + to_text(range.from) + " to " + to_text(range.to) + ": it must run upwards");
        }
        if (range.logarithmic && range.from <= 0) {
            fail("is a range on a logarithmic scale, which must begin above 0");
        }
        if (!stepped_) {
            if (table.contains("steps")) {
                fail("is a range with 'steps', which only the design \"grid\" reads");
            }
            return {option_.name, {}, range};
        }
        return {option_.name, stepped_values(range, steps(table))};
    }

    std::vector<Given> stepped_values(const OpenRange& range, std::int64_t steps) const {
        std::vector<Given> values;
        for (std::int64_t k = 0; k < steps; ++k) {
            values.push_back(range.at(static_cast<double>(k) / static_cast<double>(steps - 1)));
            if (k > 0 && values[values.size() - 2] == values.back()) {
                fail("is a range with more steps than values");
            }
        }
        return values;
    }

    const Option& option_;
    const std::string& where_;
    bool stepped_;
};

}  // namespace

Given OpenRange::at(double place) const {
    double value = logarithmic ? std::exp(std::log(from) + place * (std::log(to) - std::log(from))) : from + place * (to - from);
    value = place == 0 ? from : place == 1 ? to : value;
    return whole ? Given(static_cast<std::int64_t>(std::llround(value))) : Given(value);
}

Given Axis::at(double place) const {
    if (range) {
        return range->at(place);
    }
    const auto part = static_cast<std::size_t>(place * static_cast<double>(values.size()));
    return values[std::min(part, values.size() - 1)];
}

Axis read_axis(const toml::node& node, const Option& option, const std::string& where, bool stepped) {
    return AxisReader(option, where, stepped).read(node);
}

}  // namespace coagula::stages
