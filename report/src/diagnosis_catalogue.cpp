// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/diagnosis_catalogue.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/mechanism.hpp>

namespace coagula::report {

namespace {

using diagnose::Mechanism;
using diagnose::MechanismParameter;

std::string prior_of(const MechanismParameter& parameter) {
    if (parameter.small > 0) {
        return "uniform in the logarithm beyond " + to_text(parameter.small) + " of either sign";
    }
    return parameter.logarithmic ? "uniform in the logarithm" : "uniform";
}

/// Name, range and unit; priors are uniform in the logarithm unless said otherwise.
std::string described(const MechanismParameter& parameter) {
    return "`" + parameter.name + "` " + to_text(parameter.low) + " .. " + to_text(parameter.high) +
           (parameter.unit == "1" ? "" : " " + parameter.unit) + (parameter.logarithmic ? "" : ", " + prior_of(parameter));
}

std::string row_of(const Mechanism& mechanism) {
    std::string parameters;
    for (const MechanismParameter& parameter : mechanism.parameters) {
        parameters += (parameters.empty() ? "" : "; ") + described(parameter);
    }
    return "| " + mechanism.name + " | " + mechanism.term + " | " + mechanism.signature + " | " + parameters + " |\n";
}

Json to_json(const Mechanism& mechanism) {
    Json parameters = Json::object();
    for (const MechanismParameter& parameter : mechanism.parameters) {
        parameters[parameter.name] = {
            {"low", parameter.low}, {"high", parameter.high}, {"unit", parameter.unit}, {"prior", prior_of(parameter)}};
    }
    return {{"name", mechanism.name},
            {"term", mechanism.term},
            {"signature", mechanism.signature},
            {"in_contact", mechanism.in_contact},
            {"parameters", parameters}};
}

}  // namespace

std::string catalogue_table() {
    std::string text = "| cause | what it changes | how it shows | parameters and their range |\n|---|---|---|---|\n";
    for (const Mechanism& mechanism : diagnose::catalogue()) {
        text += row_of(mechanism);
    }
    return text;
}

Json catalogue_json() {
    Json json = Json::array();
    for (const Mechanism& mechanism : diagnose::catalogue()) {
        json.push_back(to_json(mechanism));
    }
    return json;
}

}  // namespace coagula::report
