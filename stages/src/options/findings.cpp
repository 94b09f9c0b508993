// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/findings.hpp>

#include <set>

namespace coagula::stages {

namespace {

const std::string characterization = "/characterization";

/// "pore_size" of "/characterization/pore_size/mean", and of "/characterization/uncertainty/pore_size/mean".
std::string measured_thing(const std::string& path) {
    const std::string uncertainty = characterization + "/uncertainty/";
    const std::size_t begin = path.starts_with(uncertainty) ? uncertainty.size() : characterization.size() + 1;
    return path.substr(begin, path.find('/', begin) - begin);
}

}  // namespace

std::vector<std::string> replaced_groups(const Findings& found) {
    if (found.group != characterization) {
        return {found.group};
    }
    std::set<std::string> groups = {characterization + "/left_out"};  // it tells of the last call
    for (const io::Dataset& dataset : found.results) {
        const std::string name = measured_thing(dataset.path);
        // The noise that moved them is one for all measures of a call.
        for (const char* part : {"/", "/uncertainty/", "/noise/shift/", "/noise/shift_error/"}) {
            groups.insert(characterization + part + name);
        }
    }
    return {groups.begin(), groups.end()};
}

io::Addition addition_of(const Findings& found, const std::optional<ContactNetwork>& bonds, const io::Provenance& provenance) {
    Results all = found.results;
    all.insert(all.end(), found.bond_results.begin(), found.bond_results.end());
    return {.replaced = replaced_groups(found),
            .bonds = bonds,
            .fields = found.fields,
            .results = std::move(all),
            .provenance = provenance,
            .bond_fields = found.bond_fields};
}

}  // namespace coagula::stages
