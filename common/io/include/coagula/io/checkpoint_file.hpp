// SPDX-License-Identifier: GPL-3.0-or-later
// What the checkpoints of long runs have in common: named arrays, and a text that tells runs apart.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/progress.hpp>
#include <coagula/io/structure_file.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace coagula::io {

using Numbers = std::vector<double>;
using Integers = std::vector<std::int64_t>;

/// The data sets that every checkpoint begins with.
/// @param kind what the file is, such as "checkpoint of coagula shear --method dem".
/// @param signature text that tells runs apart: options and structure.
std::vector<Dataset> checkpoint_head(const std::string& kind, const std::string& signature);

void put(std::vector<Dataset>& all, const std::string& path, Numbers values);
void put(std::vector<Dataset>& all, const std::string& path, Integers values);

/// Writes the data sets and a checksum of them by temporary file and rename.
void write_checkpoint_file(const std::string& path, std::vector<Dataset> all);

/// Data sets by path, with a sentence for what is missing.
class CheckpointReader {
public:
    /// Throws InputError when the file is no checkpoint of this kind, is damaged or belongs to another run.
    CheckpointReader(const std::string& path, std::string kind, const std::string& signature);

    bool has(const std::string& name) const { return datasets_.contains(name); }

    template <class Values>
    const Values& get(const std::string& name) const {
        const auto found = datasets_.find(name);
        if (found == datasets_.end() || !std::holds_alternative<Values>(found->second.values)) {
            throw InputError(path_ + ": " + name + " is missing: this is no " + kind_);
        }
        return std::get<Values>(found->second.values);
    }

    /// The values of a table with so many columns.
    template <class Values>
    const Values& table(const std::string& name, std::size_t columns, std::size_t rows) const {
        const auto& values = get<Values>(name);
        if (values.size() != columns * rows) {
            throw InputError(path_ + ": " + name + " has " + std::to_string(values.size()) + " values, not " +
                             std::to_string(columns * rows) + ": the checkpoint is damaged");
        }
        return values;
    }

    /// Such a table of finite numbers.
    const Numbers& finite(const std::string& name, std::size_t columns, std::size_t rows) const;

    /// Throws InputError unless low <= value < high; `what` names it, such as "an axis".
    std::int64_t whole(std::int64_t value, std::int64_t low, std::int64_t high, const std::string& what) const;
    int axis(std::int64_t value) const { return static_cast<int>(whole(value, 0, 3, "an axis")); }
    int small_count(std::int64_t value, const std::string& what) const {
        return static_cast<int>(whole(value, 0, std::int64_t{1} << 31, what));
    }

    [[noreturn]] void fail(const std::string& rule) const { throw InputError(path_ + " " + rule); }

private:
    std::string path_;
    std::string kind_;
    std::map<std::string, Dataset> datasets_;
};

/// Runs `work`, which saves its state under `path` (empty: nowhere). Whoever interrupts it reads where that is.
template <class Work>
auto with_checkpoint(const std::string& path, const Work& work) {
    try {
        return work();
    } catch (const Cancelled&) {
        if (!path.empty() && std::filesystem::exists(path)) {
            throw std::runtime_error("interrupted: the state of the run is in " + path + ", and the same call goes on from it");
        }
        throw;
    }
}

}  // namespace coagula::io
