// SPDX-License-Identifier: GPL-3.0-or-later
#include "network_keys.hpp"

#include <coagula/mechanics/load_structure.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace coagula::stages {

namespace {

/// The linear response at the stiffness as found; nothing where contacts have none, or where the network is unstable under its
/// prestress.
std::optional<mechanics::LinearResponse> response_as_found(const Packing& packing, const ContactNetwork& bonds,
                                                           const ContactModel& model, const Progress& progress) {
    mechanics::LinearOptions options;
    options.bond_tangents = mechanics::bond_tangents(packing, bonds, model);
    const bool stiff = std::all_of(options.bond_tangents.begin(), options.bond_tangents.end(),
                                   [](const ContactTangent& tangent) { return tangent.normal > 0; });
    if (!stiff) {
        return std::nullopt;
    }
    try {
        return mechanics::solve_linear(packing, bonds, options, progress);
    } catch (const Cancelled&) {
        throw;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

/// The linear response with springs of 1 N/m, of which only the counts are used: they do not depend on the stiffness.
mechanics::LinearResponse response_for_counts(const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    mechanics::LinearOptions options;
    options.normal_stiffness = 1;
    options.shear_stiffness = 1;
    mechanics::LinearResponse counted = mechanics::solve_linear(packing, bonds, options, progress);
    counted.floppy_modes = -1;
    counted.affine_tensor.setConstant(unset);
    return counted;
}

}  // namespace

std::optional<mechanics::LinearResponse> append_network_keys(Results& results, const std::string& group, const Packing& packing,
                                                             const ContactNetwork& bonds, const ContactModel& model,
                                                             const Progress& progress) {
    std::optional<mechanics::LinearResponse> found = response_as_found(packing, bonds, model, progress);
    const mechanics::LinearResponse linear = found ? *found : response_for_counts(packing, bonds, progress);
    results.push_back(io::integer(group + "rattlers", linear.rattlers, "particles that carry no load, at the start"));
    results.push_back(io::integer(group + "floppy_modes", linear.floppy_modes,
                                  "zero-energy modes of the load-bearing particles at the start; -1: not counted"));
    results.push_back(io::scalar(group + "affine_modulus", linear.mean_affine_modulus(), "Pa",
                                 found
                                     ? "shear modulus if all particles followed the strain, mean, at the start"
                                     : "NaN: the contacts have no stiffness at the start, or are unstable under their prestress"));
    return found;
}

bool has_modulus(const mechanics::LinearResponse& linear, const mechanics::ShearOrientation& orientation) {
    return linear.shear_modulus(orientation.normal, orientation.direction) != 0;
}

void append_reason(Findings& found, const Packing& packing, const ContactNetwork& bonds, const mechanics::LinearResponse& linear) {
    const std::vector<mechanics::ShearOrientation> all = mechanics::all_orientations();
    if (std::all_of(all.begin(), all.end(), [&](const auto& orientation) { return has_modulus(linear, orientation); })) {
        return;
    }
    const std::string reason = mechanics::find_load_structure(packing, bonds, linear).summary();
    found.results.push_back(io::text(found.group + "/no_modulus", reason, "in which planes the network has no modulus, and why"));
    found.table.emplace_back("load", reason);
}

void append_reason(Findings& found, const Packing& packing, const ContactNetwork& bonds, const Progress& progress) {
    append_reason(found, packing, bonds, response_for_counts(packing, bonds, progress));
}

void append_contact_stiffness(Results& results, const std::string& group, const Packing& packing, const ContactNetwork& bonds,
                              const ContactModel& model) {
    const auto tangents = mechanics::bond_tangents(packing, bonds, model);
    const auto mean = [&](double ContactTangent::*part) {
        const double sum = std::accumulate(tangents.begin(), tangents.end(), 0.0,
                                           [&](double all, const ContactTangent& tangent) { return all + tangent.*part; });
        return tangents.empty() ? unset : sum / static_cast<double>(tangents.size());
    };
    const std::string description =
        tangents.empty() ? "NaN: there are no contacts" : "mean stiffness of a contact as found, two particles in series";
    results.push_back(io::scalar(group + "contact_stiffness/normal", mean(&ContactTangent::normal), "N/m", description));
    results.push_back(io::scalar(group + "contact_stiffness/shear", mean(&ContactTangent::shear), "N/m", description));
}

}  // namespace coagula::stages
