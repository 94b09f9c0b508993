// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/spelling.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/io/input_file.hpp>
#include <coagula/io/units.hpp>

#include <toml++/toml.h>

#include <algorithm>

namespace coagula::io {

namespace {

toml::table parse(const std::string& path) {
    const std::string text = read_toml_text(path);
    try {
        return toml::parse(text, path);
    } catch (const toml::parse_error& error) {
        throw InputError(path + ", line " + std::to_string(error.source().begin.line) +
                         ": not TOML: " + std::string(error.description()));
    }
}

const ContactParameter* find_parameter(std::string_view name) {
    const auto all = contact_parameters();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ContactParameter& entry) { return entry.name == name; });
    return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> parameter_names() {
    std::vector<std::string> names;
    for (const ContactParameter& parameter : contact_parameters()) {
        names.emplace_back(parameter.name);
    }
    return names;
}

double read_value(const toml::node& node, const ContactParameter& parameter, const std::string& where) {
    if (node.is_string()) {
        try {
            return parse_quantity(node.ref<std::string>(), parameter.unit);
        } catch (const InputError& error) {
            throw InputError(where + ": " + error.what());
        }
    }
    if (!node.is_number()) {
        throw InputError(where + ": the value must be a number or a text such as \"1 " + parameter.unit + "\"");
    }
    const double value = *node.value<double>();
    if (!std::isfinite(value)) {
        throw InputError(where + ": the value is not a finite number");
    }
    return value;
}

}  // namespace

ContactModel read_contact_model(const std::string& path, const ContactModel& base) {
    ContactModel model = base;
    for (const auto& [key, node] : parse(path)) {
        const std::string where = path + ", key '" + std::string(key.str()) + "'";
        const ContactParameter* parameter = find_parameter(key.str());
        if (parameter == nullptr) {
            throw InputError(where + ": there is no such parameter of the contact model" +
                             did_you_mean(key.str(), parameter_names()));
        }
        model.*parameter->value = read_value(node, *parameter, where);
    }
    try {
        check(model);
    } catch (const std::invalid_argument& error) {
        throw InputError(path + ": " + error.what());
    }
    return model;
}

std::string contact_model_text(const ContactModel& model) {
    std::string text;
    for (const ContactParameter& parameter : contact_parameters()) {
        if (parameter.is_set(model)) {
            const std::string unit = parameter.unit == "1" ? "" : " " + parameter.unit;
            text += parameter.name + " = \"" + to_text(model.*parameter.value) + unit + "\"\n";
        }
    }
    return text;
}

}  // namespace coagula::io
