// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/results.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace coagula::report {

namespace {

template <class T>
Json to_value(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
        return std::isfinite(value) ? Json(value) : Json(nullptr);
    } else {
        return Json(value);
    }
}

[[noreturn]] void refuse_number(const std::string& name) {
    throw std::runtime_error("the result " + name +
                             " is not a finite number, and nothing is written: an option or a parameter of this call lies far "
                             "outside physical values");
}

void check_finite_below(const Json& json, const std::string& path) {
    if (json.is_number_float() && !std::isfinite(json.get<double>())) {
        refuse_number(path.substr(1));
    }
    if (json.is_structured()) {
        for (const auto& [key, value] : json.items()) {
            check_finite_below(value, path + "/" + key);
        }
    }
}

/// The values from `first` on, nested as the shape from `level` on says.
template <class T>
Json nested(const std::vector<T>& values, const std::vector<std::size_t>& shape, std::size_t level, std::size_t& next) {
    if (level == shape.size()) {
        return to_value(values.at(next++));
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < shape[level]; ++i) {
        list.push_back(nested(values, shape, level + 1, next));
    }
    return list;
}

}  // namespace

Json to_json(const io::Dataset& dataset) {
    if (const auto* text = std::get_if<std::string>(&dataset.values)) {
        return *text;
    }
    std::size_t next = 0;
    if (const auto* numbers = std::get_if<std::vector<double>>(&dataset.values)) {
        return nested(*numbers, dataset.shape, 0, next);
    }
    return nested(std::get<std::vector<std::int64_t>>(dataset.values), dataset.shape, 0, next);
}

Json to_json(const Results& results, const std::string& group) {
    Json json = Json::object();
    for (const io::Dataset& dataset : results) {
        json[Json::json_pointer(dataset.path.substr(group.size()))] = to_json(dataset);
    }
    return json;
}

void check_finite(const Results& results) {
    const auto finite = [](double value) { return std::isfinite(value); };
    for (const io::Dataset& dataset : results) {
        const auto* numbers = std::get_if<std::vector<double>>(&dataset.values);
        const bool may_be_missing = dataset.description.find("NaN") != std::string::npos;
        if (numbers != nullptr && !may_be_missing && !std::all_of(numbers->begin(), numbers->end(), finite)) {
            refuse_number(dataset.path);
        }
    }
}

void check_finite(const Json& json) {
    check_finite_below(json, "");
}

}  // namespace coagula::report
