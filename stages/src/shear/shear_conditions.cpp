// SPDX-License-Identifier: GPL-3.0-or-later
#include "shear_conditions.hpp"

#include <coagula/common/readable.hpp>
#include <coagula/io/contact_model_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/units.hpp>

#include <algorithm>
#include <map>
#include <vector>

namespace coagula::stages {

namespace {

const std::vector<std::string>& conditions_of_all() {
    static const std::vector<std::string> names = {"normal-stiffness", "shear-stiffness", "bond-tolerance", "model", "relax"};
    return names;
}

/// The others, by the group of the results.
const std::map<std::string, std::vector<std::string>>& conditions_by_group() {
    static const std::map<std::string, std::vector<std::string>> names = {
        {"/mechanics/linear", {}},
        {"/mechanics/frequency", {"frequency", "frequency-sweep"}},
        {"/mechanics/quasistatic",
         {"rest-length", "orientation", "amplitudes", "reverse", "cycles", "steps-per-cycle", "ramp", "ramp-steps", "frequency",
          "frequency-sweep"}},
        {"/mechanics/compression", {"rest-length", "orientation", "ramp", "ramp-steps", "strain"}},
        {"/mechanics/dem",
         {"rest-length", "orientation", "boundary", "amplitude", "constant-amplitude", "oscillations", "steps-per-oscillation",
          "damping", "density", "frequency", "frequency-sweep"}}};
    return names;
}

/// LAMMPS brings a strained network to rest, whatever the oscillation of the builtin engine is.
const std::vector<std::string>& conditions_of(const ShearRun& run) {
    static const std::vector<std::string> with_lammps = {"engine", "rest-length", "orientation"};
    return run.lammps ? with_lammps : conditions_by_group().at(run.group());
}

/// A list with its quantities as SI numbers, so that "1e-3,1kHz" and "0.001,1000" are the same condition.
std::string with_plain_numbers(const std::string& list, const std::string& unit) {
    std::string text;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find_first_of(",:", begin), list.size());
        const std::string word = list.substr(begin, end - begin);
        try {
            text += to_text(io::parse_quantity(word, unit));
        } catch (const InputError&) {  // a name, such as that of an orientation
            text += word;
        }
        text += end < list.size() ? std::string(1, list[end]) : "";
        begin = end + 1;
    }
    return text;
}

io::Dataset condition(const Arguments& arguments, const Option& option, const std::string& path) {
    switch (option.kind) {
        case Option::Kind::flag:
            return io::integer(path, 1, option.meaning);
        case Option::Kind::count:
            return io::integer(path, arguments.count(option.name), option.meaning);
        case Option::Kind::quantity:
            return io::scalar(path, arguments.quantity(option.name), option.unit, option.meaning);
        case Option::Kind::text:
            break;
    }
    return io::text(path, with_plain_numbers(arguments.text(option.name), option.name.starts_with("frequency") ? "Hz" : "1"),
                    option.meaning);
}

}  // namespace

Results shear_conditions(const Arguments& arguments, const ShearRun& run) {
    const std::string group = run.group();
    std::vector<std::string> names = conditions_of_all();
    const std::vector<std::string>& own = conditions_of(run);
    names.insert(names.end(), own.begin(), own.end());
    Results conditions;
    for (const Option& option : shear_verb().options) {
        if (std::find(names.begin(), names.end(), option.name) == names.end() || !arguments.has(option.name)) {
            continue;
        }
        std::string path = group + "/conditions/" + option.name;
        std::replace(path.begin(), path.end(), '-', '_');
        conditions.push_back(option.name == "model"
                                 ? io::text(path, io::contact_model_text(run.model), "the contact as a TOML file")
                                 : condition(arguments, option, path));
    }
    return conditions;
}

}  // namespace coagula::stages
