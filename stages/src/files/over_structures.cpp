// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/over_structures.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::stages {

namespace {

Json set_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// The mean modulus of a structure as a list: one number, or one for each entry of a sweep.
Json entries_of(const Json& structure, const std::string& modulus) {
    const Json& mean = structure.at(modulus).at("mean");
    return mean.is_array() ? mean : Json::array({mean});
}

/// Nothing where a structure has no number there.
std::optional<MeanWithError> mean_of_entry(const std::vector<Json>& structures, const std::string& modulus, std::size_t entry) {
    Eigen::VectorXd values(static_cast<Index>(structures.size()));
    for (std::size_t k = 0; k < structures.size(); ++k) {
        const Json entries = entries_of(structures[k], modulus);
        if (entry >= entries.size() || !entries[entry].is_number()) {
            return std::nullopt;
        }
        values[static_cast<Index>(k)] = entries[entry].get<double>();
    }
    return mean_and_standard_error(values);
}

std::string with_error(const MeanWithError& found) {
    return with_unit(found.mean, "Pa") + ", standard error " + with_unit(found.standard_error, "Pa") + ", standard deviation " +
           with_unit(found.standard_deviation, "Pa");
}

}  // namespace

Json to_json(const MeanWithError& found) {
    return {{"structures", found.count},
            {"mean", set_or_null(found.mean)},
            {"std", set_or_null(found.standard_deviation)},
            {"standard_error", set_or_null(found.standard_error)}};
}

Json over_structures(const std::vector<Json>& structures) {
    Json json = {{"structures", structures.size()}};
    for (const std::string modulus : {"storage_modulus", "loss_modulus", "longitudinal_modulus"}) {
        if (!structures.front().contains(modulus)) {
            continue;
        }
        const bool sweep = structures.front().at(modulus).at("mean").is_array();
        const std::size_t count = entries_of(structures.front(), modulus).size();
        Json all = {{"mean", Json::array()}, {"std", Json::array()}, {"standard_error", Json::array()}};
        for (std::size_t entry = 0; entry < count; ++entry) {
            const MeanWithError found = mean_of_entry(structures, modulus, entry).value_or(MeanWithError{});
            all["mean"].push_back(set_or_null(found.mean));
            all["std"].push_back(set_or_null(found.standard_deviation));
            all["standard_error"].push_back(set_or_null(found.standard_error));
        }
        for (auto& [key, values] : all.items()) {
            json[modulus][key] = sweep ? values : values.front();
        }
    }
    return json;
}

Table table_over_structures(const std::vector<Json>& structures) {
    Table table;
    const bool sheared = structures.front().contains("storage_modulus");
    const std::string name = sheared ? "storage_modulus" : "longitudinal_modulus";
    const std::string symbol = sheared ? "G' " : "longitudinal modulus ";
    const std::size_t count = entries_of(structures.front(), name).size();
    for (const Json& structure : structures) {
        const Json& modulus = structure.at(name);
        if (count == 1 && modulus.at("mean").is_number()) {
            table.emplace_back(structure.at("file").get<std::string>(), symbol + with_unit(modulus.at("mean").get<double>(), "Pa") +
                                                                            " +- " +
                                                                            with_unit(modulus.at("std").get<double>(), "Pa"));
        }
    }
    if (!table.empty()) {
        table.emplace_back("", "+- is the standard deviation over the orientations of one structure");
    }
    for (std::size_t entry = 0; entry < count; ++entry) {
        const auto mean = mean_of_entry(structures, name, entry);
        const std::string place = count > 1 ? ", entry " + std::to_string(entry + 1) : "";
        table.emplace_back("mean of " + std::to_string(structures.size()) + place,
                           mean ? symbol + with_error(*mean) : "not reached by every structure");
    }
    if (count > 0) {
        table.emplace_back("", "standard errors follow from the scatter between structures");
    }
    return table;
}

}  // namespace coagula::stages
