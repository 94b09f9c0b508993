// SPDX-License-Identifier: GPL-3.0-or-later
// A GSD file in memory: its chunks by frame and name, whatever the schema says they mean.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gsd_layout.hpp"

namespace coagula::io {

class GsdFile {
public:
    /// Throws InputError when the file cannot be read, is damaged, or has not the schema hoomd of version 1.
    explicit GsdFile(const std::string& path);

    [[noreturn]] void fail(const std::string& what) const;
    std::size_t size() const { return bytes_.size(); }
    std::uint64_t frames() const { return chunks_.empty() ? 0 : chunks_.rbegin()->first.first + 1; }

    /// The numbers of a chunk; empty where the frame has none of that name.
    std::vector<double> numbers(std::uint64_t frame, const std::string& name) const;
    /// The numbers of a chunk, or those of the first frame where this one has none.
    std::vector<double> numbers_or_first(std::uint64_t frame, const std::string& name) const;
    /// rows x columns finite numbers. What a frame does not have it takes from the first one, if that has as many; otherwise the
    /// result is empty. Throws InputError for another size and for numbers that are not finite.
    std::vector<double> values(std::uint64_t frame, const std::string& name, std::size_t rows, std::size_t columns) const;
    /// Texts, one a row of bytes; those of the first frame where this one has none.
    std::vector<std::string> texts_or_first(std::uint64_t frame, const std::string& name) const;
    /// Names that chunks of the file have.
    const std::vector<std::string>& names() const { return names_; }

private:
    const gsd::Entry* find(std::uint64_t frame, const std::string& name) const;
    bool holds(std::uint64_t location, std::uint64_t count, std::uint64_t size) const;
    void read_header();
    void read_names();
    void read_index();

    std::string path_;
    std::string bytes_;
    gsd::Header header_{};
    std::vector<std::string> names_;
    std::map<std::pair<std::uint64_t, std::string>, gsd::Entry> chunks_;
};

}  // namespace coagula::io
