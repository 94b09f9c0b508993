// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/spelling.hpp>

#include <algorithm>
#include <cctype>

namespace coagula {

namespace {

constexpr std::size_t longest_word = 64;  ///< no name is as long: nothing near it is looked for

std::string plain(std::string_view word) {
    std::string text;
    for (const char c : word) {
        text += c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return text;
}

}  // namespace

std::size_t edit_distance(std::string_view first, std::string_view second) {
    std::vector<std::size_t> before_last(second.size() + 1);
    std::vector<std::size_t> last(second.size() + 1);
    std::vector<std::size_t> row(second.size() + 1);
    for (std::size_t j = 0; j <= second.size(); ++j) {
        row[j] = j;
    }
    for (std::size_t i = 1; i <= first.size(); ++i) {
        before_last.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= second.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (first[i - 1] == second[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && first[i - 1] == second[j - 2] && first[i - 2] == second[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
    }
    return row[second.size()];
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
    if (word.empty() || word.size() > longest_word) {
        return {};
    }
    const std::string wanted = plain(word);
    const std::string* nearest = nullptr;
    std::size_t least = std::max<std::size_t>(1, wanted.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(wanted, plain(name));
        if (distance < least && distance < wanted.size()) {
            least = distance;
            nearest = &name;
        }
    }
    for (const std::string& name : names) {
        const bool begins = wanted.size() >= 3 && plain(name).starts_with(wanted);
        if (begins && least > 1 && (nearest == nullptr || !plain(*nearest).starts_with(wanted) || name.size() < nearest->size())) {
            nearest = &name;
        }
    }
    return nearest == nullptr ? std::string{} : *nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names, std::string_view prefix) {
    const std::string name = nearest_name(word, names);
    return name.empty() ? name : "; did you mean '" + std::string(prefix) + name + "'?";
}

}  // namespace coagula
