// SPDX-License-Identifier: GPL-3.0-or-later
// A TOML table whose keys are taken one by one; a key that nobody takes is an error.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace coagula::experiment {

/// Throws InputError when the file cannot be read or is not TOML.
toml::table parse_toml(const std::string& path);

class TomlKeys {
public:
    /// @param where names the table in messages: "experiment.toml, [sample]".
    TomlKeys(const toml::table& table, std::string where) : table_(table), where_(std::move(where)) {}

    std::optional<std::string> text(const std::string& key);
    /// A number in `unit`, or a text with a unit of its own.
    std::optional<double> quantity(const std::string& key, const std::string& unit);
    /// Seconds: of a date and time (2022-11-14T16:32:00, "2022-11-14 16:32"), or a quantity of time.
    std::optional<double> moment(const std::string& key);
    std::optional<std::int64_t> whole(const std::string& key);
    /// A whole number from `low` on that an int holds; `low` without the key.
    int small_count(const std::string& key, std::int64_t low);
    /// True or false; false without the key.
    bool flag(const std::string& key);
    /// A list of texts, or one text.
    std::vector<std::string> texts(const std::string& key);
    /// Whether the key is there and holds a list.
    bool holds_list(const std::string& key) const;
    /// A list of whole numbers, or one.
    std::vector<std::int64_t> wholes(const std::string& key);
    /// A table of texts or numbers, as key and node.
    std::vector<std::pair<std::string, const toml::node*>> entries(const std::string& key);
    /// A text that a table of `entries` holds.
    std::string text_of(const toml::node& node, const std::string& key) const;
    double quantity_of(const toml::node& node, const std::string& key, const std::string& unit) const;

    std::string required_text(const std::string& key);
    /// Marks a key as known without reading it.
    void ignore(const std::string& key) { taken_.insert(key); }
    /// Throws InputError for the first key that was not asked for.
    void refuse_other_keys() const;
    /// Throws InputError "FILE, [table], key 'key': rule".
    [[noreturn]] void fail(const std::string& key, const std::string& rule) const;

private:
    const toml::node* take(const std::string& key);

    const toml::table& table_;
    std::string where_;
    std::set<std::string> taken_;
};

}  // namespace coagula::experiment
