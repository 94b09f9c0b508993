// SPDX-License-Identifier: GPL-3.0-or-later
#include "signature.hpp"

#include <coagula/io/checksums.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/stages/generate.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace coagula::stages {

namespace {

/// The option that says where a trajectory ends on which other structures may lie; empty where there is none. The samples of a run
/// follow from its stop time where their interval is not given.
std::string stop_of(const Arguments& arguments) {
    if (arguments.verb() != generate_brownian_verb().name || arguments.text("engine") != "builtin") {
        return "";
    }
    if (arguments.has("stop-time") && !arguments.has("sample-interval")) {
        return "";
    }
    return arguments.has("stop-coordination") ? "stop-coordination" : arguments.has("stop-time") ? "stop-time" : "";
}

/// Whether an option has its default, given or not.
bool is_default(const Arguments& arguments, const Option& option) {
    if (!arguments.given(option.name)) {
        return true;
    }
    switch (option.kind) {
        case Option::Kind::count:
            return !option.fallback.empty() &&
                   static_cast<double>(arguments.count(option.name)) == parse_quantity(option.fallback, "1", option.range);
        case Option::Kind::quantity:
            return !option.fallback.empty() &&
                   arguments.quantity(option.name) == parse_quantity(option.fallback, option.unit, option.range);
        case Option::Kind::text:
            return arguments.text(option.name) == option.fallback;
        case Option::Kind::flag:
            return false;
    }
    return false;
}

}  // namespace

Signature signature_of(const Verb& verb, const Arguments& arguments) {
    nlohmann::ordered_json options = arguments.to_json();
    for (const Option& option : verb.options) {  // options of later versions do not change the signature of a call without them
        if (is_default(arguments, option)) {
            options.erase(option.name);
        }
    }
    const std::vector<std::string> files = arguments.files(Option::File::read);
    for (auto& value : options) {
        if (value.is_string() && std::find(files.begin(), files.end(), value.get<std::string>()) != files.end() &&
            std::filesystem::is_regular_file(value.get<std::string>())) {
            value = io::sha256(io::read_file(value.get<std::string>()));
        }
    }
    Signature signature{.text = arguments.verb() + options.dump(), .of_trajectory = {}};
    if (const std::string stop = stop_of(arguments); !stop.empty()) {
        options.erase(stop);
        signature.stop = arguments.quantity(stop);
    }
    signature.of_trajectory = arguments.verb() + options.dump();
    return signature;
}

}  // namespace coagula::stages
