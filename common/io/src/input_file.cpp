// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/input_file.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

namespace coagula::io {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_toml = 1 << 20;  // bytes
constexpr std::size_t deepest_toml = 64;          // levels

/// The place behind a TOML string that begins at `begin`; one that is not closed ends with its line.
std::size_t behind_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const bool many_lines = text.substr(begin, 3) == std::string(3, quote);
    const std::string end(many_lines ? 3 : 1, quote);
    for (std::size_t place = begin + end.size(); place < text.size(); ++place) {
        if (text[place] == '\\' && quote == '"') {
            ++place;
        } else if (text.substr(place, end.size()) == end) {
            return place + end.size();
        } else if (text[place] == '\n' && !many_lines) {
            return place;
        }
    }
    return text.size();
}

/// How deep the present place of a TOML text lies: in brackets, and in the tables that dots in keys make.
class Nesting {
public:
    void take(char c) {
        if (c == '[' || c == '{') {
            outer_.push_back(level());
            dots_ = 0;
        } else if (c == ']' || c == '}') {
            outer_.resize(outer_.empty() ? 0 : outer_.size() - 1);
            dots_ = 0;
        } else if (c == ',' || c == '\n') {
            dots_ = 0;
        } else if (c == '.') {
            ++dots_;
        }
    }
    std::size_t level() const { return (outer_.empty() ? 0 : outer_.back() + 1) + dots_; }

private:
    std::vector<std::size_t> outer_;  ///< level at each open bracket
    std::size_t dots_ = 0;            ///< in the present key
};

void check_nesting(std::string_view text, const std::string& path) {
    Nesting nesting;
    for (std::size_t place = 0; place < text.size();) {
        if (text[place] == '"' || text[place] == '\'') {
            place = behind_string(text, place);
            continue;
        }
        if (text[place] == '#') {
            place = std::min(text.find('\n', place), text.size());
            continue;
        }
        nesting.take(text[place++]);
        if (nesting.level() > deepest_toml) {
            const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place - 1), '\n');
            throw InputError(path + ", line " + std::to_string(line) + ": tables and arrays are nested deeper than " +
                             std::to_string(deepest_toml) + " levels");
        }
    }
}

}  // namespace

void check_input(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::none) {
        throw InputError(path + " cannot be read: " + error.message());
    }
    if (!fs::exists(status)) {
        throw InputError(path + " does not exist");
    }
    if (!fs::is_regular_file(status)) {
        throw InputError(path + " cannot be read: it is " + (fs::is_directory(status) ? "a folder" : "not a regular file"));
    }
}

std::string read_file(const std::string& path) {
    check_input(path);
    std::ifstream stream(path, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (!stream) {
        throw InputError(path + " cannot be read");
    }
    return text;
}

std::string read_toml_text(const std::string& path) {
    check_input(path);
    std::error_code error;
    if (fs::file_size(path, error) > largest_toml && !error) {
        throw InputError(path + " is too large for a TOML file: it may have a megabyte at most");
    }
    std::string text = read_file(path);
    check_nesting(text, path);
    return text;
}

}  // namespace coagula::io
