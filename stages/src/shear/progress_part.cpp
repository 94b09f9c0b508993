// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_part.hpp"

#include <algorithm>

namespace coagula::stages {

Progress part_of(const Progress& whole, std::string stage, std::size_t number, std::size_t count, std::string label) {
    const auto all = static_cast<double>(count);
    const double before = static_cast<double>(number) / all;
    return Progress([&whole, stage = std::move(stage), label = std::move(label), all, before, reached = before](
                        std::string_view /*part*/, double fraction, std::string_view remark) mutable {
        reached = std::max(reached, before + std::clamp(fraction, 0.0, 1.0) / all);
        whole.update(stage, reached, remark.empty() ? label : label + ", " + std::string(remark));
        return true;
    });
}

std::string counted(const std::string& what, std::size_t number, std::size_t count) {
    return what + " " + std::to_string(number) + " of " + std::to_string(count);
}

}  // namespace coagula::stages
