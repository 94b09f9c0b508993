// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/recorded_options.hpp>

namespace coagula::stages {

Json recorded_options(const std::string& path, const std::string& text) {
    constexpr int deepest = 16;
    const auto refuse_deep = [&](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
        if (depth > deepest) {
            throw InputError(path + ": the options in its provenance are JSON nested deeper than " + std::to_string(deepest) +
                             " levels");
        }
        return true;
    };
    const Json options = Json::parse(text, refuse_deep, false);
    return options.is_discarded() ? Json(text) : options;
}

}  // namespace coagula::stages
