// SPDX-License-Identifier: GPL-3.0-or-later
#include "toml_keys.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/spelling.hpp>
#include <coagula/io/date_time.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace coagula::experiment {

toml::table parse_toml(const std::string& path) {
    const std::string text = io::read_toml_text(path);
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw InputError(path + ", line " + std::to_string(error.source().begin.line) +
                         ": not TOML: " + std::string(error.description()));
    }
}

const toml::node* TomlKeys::take(const std::string& key) {
    taken_.insert(key);
    return table_.get(key);
}

void TomlKeys::fail(const std::string& key, const std::string& rule) const {
    throw InputError(where_ + ", key '" + key + "': " + rule);
}

std::string TomlKeys::text_of(const toml::node& node, const std::string& key) const {
    if (!node.is_string()) {
        fail(key, "must be a text in quotes");
    }
    return node.ref<std::string>();
}

double TomlKeys::quantity_of(const toml::node& node, const std::string& key, const std::string& unit) const {
    if (node.is_string()) {
        try {
            return io::parse_quantity(node.ref<std::string>(), unit);
        } catch (const InputError& error) {
            fail(key, error.what());
        }
    }
    if (!node.is_number()) {
        fail(key, "must be a number or a text such as \"1 " + unit + "\"");
    }
    const double value = *node.value<double>();
    if (!std::isfinite(value)) {
        fail(key, "must be finite");
    }
    return value;
}

std::optional<std::string> TomlKeys::text(const std::string& key) {
    const toml::node* node = take(key);
    return node == nullptr ? std::nullopt : std::optional(text_of(*node, key));
}

std::optional<double> TomlKeys::quantity(const std::string& key, const std::string& unit) {
    const toml::node* node = take(key);
    return node == nullptr ? std::nullopt : std::optional(quantity_of(*node, key, unit));
}

std::optional<double> TomlKeys::moment(const std::string& key) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    if (const auto* date = node->as_date_time()) {
        const auto& [day, time, offset] = date->get();
        return io::seconds_of_date(day.year, day.month, day.day, time.hour, time.minute, time.second);
    }
    if (const auto written = node->is_string() ? io::seconds_of_date(node->ref<std::string>()) : std::nullopt) {
        return written;
    }
    if (node->is_date() || node->is_time()) {
        fail(key, "must have both a date and a time of day, such as 2022-11-14T16:32:00");
    }
    return quantity_of(*node, key, "s");
}

std::optional<std::int64_t> TomlKeys::whole(const std::string& key) {
    const toml::node* node = take(key);
    if (node == nullptr) {
        return std::nullopt;
    }
    const auto number = node->value<std::int64_t>();  // also of 1e6, which TOML takes for a float
    if (!number || node->is_boolean()) {
        fail(key, "must be a whole number");
    }
    return number;
}

int TomlKeys::small_count(const std::string& key, std::int64_t low) {
    const std::int64_t value = whole(key).value_or(low);
    constexpr std::int64_t high = std::numeric_limits<int>::max();
    if (value < low || value > high) {
        fail(key, "is " + std::to_string(value) + ", but must be a whole number " +
                      (value < low ? ">= " + std::to_string(low) : "<= " + std::to_string(high)));
    }
    return static_cast<int>(value);
}

bool TomlKeys::flag(const std::string& key) {
    const toml::node* node = take(key);
    if (node != nullptr && !node->is_boolean()) {
        fail(key, "must be true or false");
    }
    return node != nullptr && *node->value<bool>();
}

std::vector<std::string> TomlKeys::texts(const std::string& key) {
    const toml::node* node = take(key);
    std::vector<std::string> list;
    if (node != nullptr && node->is_array()) {
        for (const toml::node& item : *node->as_array()) {
            list.push_back(text_of(item, key));
        }
    } else if (node != nullptr) {
        list.push_back(text_of(*node, key));
    }
    return list;
}

bool TomlKeys::holds_list(const std::string& key) const {
    const toml::node* node = table_.get(key);
    return node != nullptr && node->is_array();
}

std::vector<std::int64_t> TomlKeys::wholes(const std::string& key) {
    const toml::node* node = take(key);
    std::vector<std::int64_t> list;
    const auto add = [&](const toml::node& item) {
        const auto number = item.value<std::int64_t>();
        if (!number || item.is_boolean()) {
            fail(key, "must be a whole number or a list of them");
        }
        list.push_back(*number);
    };
    if (node != nullptr && node->is_array()) {
        for (const toml::node& item : *node->as_array()) {
            add(item);
        }
    } else if (node != nullptr) {
        add(*node);
    }
    return list;
}

std::vector<std::pair<std::string, const toml::node*>> TomlKeys::entries(const std::string& key) {
    const toml::node* node = take(key);
    std::vector<std::pair<std::string, const toml::node*>> list;
    if (node != nullptr && !node->is_table()) {
        fail(key, "must be a table such as { storage_modulus = \"...\" }");
    }
    if (node != nullptr) {
        for (const auto& [name, value] : *node->as_table()) {
            list.emplace_back(std::string(name.str()), &value);
        }
    }
    return list;
}

std::string TomlKeys::required_text(const std::string& key) {
    const auto found = text(key);
    if (!found) {
        throw InputError(where_ + ": the key '" + key + "' is missing");
    }
    return *found;
}

void TomlKeys::refuse_other_keys() const {
    for (const auto& [key, node] : table_) {
        if (!taken_.contains(std::string(key.str()))) {
            std::vector<std::string> free;
            std::copy_if(taken_.begin(), taken_.end(), std::back_inserter(free),
                         [&](const std::string& name) { return !table_.contains(name); });
            fail(std::string(key.str()), "there is no such key here" + did_you_mean(key.str(), free));
        }
    }
}

}  // namespace coagula::experiment
