// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/conditions.hpp>

#include <coagula/common/failures.hpp>
#include <coagula/common/readable.hpp>
#include <coagula/io/structure_file.hpp>

#include <map>
#include <set>

namespace coagula::io {

namespace {

/// The conditions by name, each with its value as it is printed.
using Conditions = std::map<std::string, std::string>;

std::string shown(const Dataset& dataset) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return *text;
    }
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset.values)) {
        return to_text(numbers->front()) + (dataset.unit == "1" ? "" : " " + dataset.unit);
    }
    return std::to_string(std::get<std::vector<std::int64_t>>(dataset.values).front());
}

Conditions conditions_in(const std::vector<Dataset>& results, const std::string& prefix) {
    Conditions conditions;
    for (const Dataset& dataset : results) {
        if (dataset.path.starts_with(prefix) && dataset.shape.empty()) {
            conditions[dataset.path.substr(prefix.size())] = shown(dataset);
        }
    }
    return conditions;
}

/// One condition of both, as half a sentence: "amplitudes: 0.01 there, 0.1 here". A text of several lines is not repeated.
std::string difference(const std::string& name, const Conditions& there, const Conditions& here) {
    const auto value = [&](const Conditions& conditions) {
        const auto found = conditions.find(name);
        return found == conditions.end() ? std::string("not given") : found->second;
    };
    const std::string both = value(there) + " there, " + value(here) + " here";
    return name + (both.find('\n') == std::string::npos ? ": " + both : " differs");
}

std::string differences(const Conditions& there, const Conditions& here) {
    std::set<std::string> names;
    for (const Conditions* conditions : {&there, &here}) {
        for (const auto& [name, value] : *conditions) {
            names.insert(name);
        }
    }
    std::string text;
    for (const std::string& name : names) {
        if (!there.contains(name) || !here.contains(name) || there.at(name) != here.at(name)) {
            text += (text.empty() ? "" : "; ") + difference(name, there, here);
        }
    }
    return text;
}

}  // namespace

void check_conditions(const std::string& path, const std::string& group, const std::vector<Dataset>& results) {
    const std::string prefix = group + "/conditions/";
    const Conditions here = conditions_in(results, prefix);
    if (here.empty()) {
        return;
    }
    const Conditions there = conditions_in(read_results(path, group + "/conditions"), prefix);
    const std::string different = differences(there, here);
    if (different.empty() || (there.empty() && read_results(path, group).empty())) {
        return;
    }
    throw ExistsAlready(path + " holds results in " + group + " that were found under other conditions (" +
                        (there.empty() ? "which it does not name" : different) +
                        "); give --force to replace them, or -o FILE to write a copy with the new ones");
}

}  // namespace coagula::io
