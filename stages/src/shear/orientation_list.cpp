// SPDX-License-Identifier: GPL-3.0-or-later
#include "orientation_list.hpp"

#include <coagula/stages/arguments.hpp>

#include <coagula/common/checks.hpp>

#include <algorithm>

namespace coagula::stages {

std::string name_of(const mechanics::ShearOrientation& orientation) {
    const std::string axes = "xyz";
    return {axes[static_cast<std::size_t>(orientation.normal)], axes[static_cast<std::size_t>(orientation.direction)]};
}

namespace {

/// "xy, xz, yx, yz, zx, zy (plate normal, shear direction)".
std::string list_of(const std::vector<mechanics::ShearOrientation>& all) {
    std::string names;
    for (const mechanics::ShearOrientation& orientation : all) {
        names += (names.empty() ? "" : ", ") + name_of(orientation);
    }
    return names + (all.front().is_uniaxial() ? " (axis of the compression)" : " (plate normal, shear direction)");
}

}  // namespace

std::vector<mechanics::ShearOrientation> parse_orientations(const std::string& text,
                                                            const std::vector<mechanics::ShearOrientation>& all) {
    if (text == "all") {
        return all;
    }
    std::vector<mechanics::ShearOrientation> wanted;
    std::vector<std::string> seen;
    for (const std::string& word : split(text)) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const auto& entry) { return name_of(entry) == word; });
        if (found == all.end()) {
            throw InputError("'" + word + "' is not one of " + list_of(all) + " or all");
        }
        if (std::find(seen.begin(), seen.end(), word) != seen.end()) {
            throw InputError("'" + word + "' is named twice");
        }
        seen.push_back(word);
        wanted.push_back(*found);
    }
    if (wanted.empty()) {
        throw InputError("no orientation is given");
    }
    return wanted;
}

}  // namespace coagula::stages
