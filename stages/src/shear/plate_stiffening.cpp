// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate_stiffening.hpp"

#include <coagula/mechanics/plate_stiffening.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace coagula::stages {

namespace {

using mechanics::PlateStiffening;

const std::string plates_group = "/mechanics/dem/plates/";

std::vector<mechanics::ShearOrientation> orientations_of(const mechanics::RheometerResult& result) {
    std::vector<mechanics::ShearOrientation> orientations;
    orientations.reserve(result.runs.size());
    for (const mechanics::RheometerRun& run : result.runs) {
        orientations.push_back(run.orientation);
    }
    return orientations;
}

/// Stiffening by the plates for each orientation. It has no moduli where there is no linear response.
std::vector<PlateStiffening> stiffening_of(const Packing& packing, const ContactNetwork& bonds,
                                           const std::optional<mechanics::LinearResponse>& linear,
                                           const std::vector<mechanics::ShearOrientation>& orientations, double plate_layers,
                                           const Progress& progress) {
    if (linear) {
        try {
            return mechanics::plate_stiffening(packing, bonds, *linear, orientations, plate_layers, {}, progress);
        } catch (const Cancelled&) {
            throw;
        } catch (const std::runtime_error&) {
            // Too soft for the solver: nothing is known of the plates, the run stands.
        }
    }
    std::vector<PlateStiffening> unknown;
    for (const mechanics::ShearOrientation& orientation : orientations) {
        unknown.push_back({orientation, unset, unset});
    }
    return unknown;
}

Eigen::VectorXd each(const std::vector<PlateStiffening>& found, double PlateStiffening::*value) {
    Eigen::VectorXd values(static_cast<Index>(found.size()));
    std::transform(found.begin(), found.end(), values.begin(), [&](const PlateStiffening& one) { return one.*value; });
    return values;
}

/// Mean distance between the plates, over the mean radius.
double gap(const Packing& packing, const std::vector<PlateStiffening>& found) {
    double sum = 0;
    for (const PlateStiffening& one : found) {
        sum += packing.cell.lengths()[one.orientation.normal];
    }
    return sum / static_cast<double>(found.size()) / mean_radius(packing);
}

std::string effect_text(double ratio, double between, double periodic) {
    if (std::isnan(ratio)) {
        return "with an unknown effect, because there is no linear modulus to compare with";
    }
    return std::string(ratio < 1 ? "lower" : "raise") + " G' by " + with_unit(100 * std::abs(ratio - 1), "1") + " %: linear " +
           with_unit(between, "Pa") + " with them, " + with_unit(periodic, "Pa") + " in the periodic cell";
}

}  // namespace

void append_plate_stiffening(Findings& found, const Packing& packing, const ContactNetwork& bonds,
                             const std::optional<mechanics::LinearResponse>& linear, const mechanics::RheometerResult& result,
                             double plate_layers, const Progress& progress) {
    const auto all = stiffening_of(packing, bonds, linear, orientations_of(result), plate_layers, progress);
    const Eigen::VectorXd between = each(all, &PlateStiffening::between_plates);
    const Eigen::VectorXd periodic = each(all, &PlateStiffening::periodic);
    const double ratio = PlateStiffening{{}, between.mean(), periodic.mean()}.ratio();
    const double without = result.storage_modulus() / ratio;
    const auto say = [&](const std::string& description) {
        return std::isnan(ratio) ? "NaN: the structure bears no shear at vanishing strain" : description;
    };
    const double apart = gap(packing, all);

    Results& results = found.results;
    results.push_back(io::scalar(plates_group + "gap", apart, "1", "mean distance between the plates over the mean radius"));
    results.push_back(io::vector(plates_group + "linear_modulus", between, "Pa",
                                 say("per orientation: G' of this structure between the plates at vanishing strain and rate")));
    results.push_back(io::vector(plates_group + "periodic_linear_modulus", periodic, "Pa",
                                 say("per orientation: the same of its periodic cell, without plates")));
    results.push_back(io::scalar(plates_group + "modulus_ratio", ratio, "1",
                                 say("linear_modulus over periodic_linear_modulus, means of the orientations")));
    results.push_back(io::scalar(plates_group + "periodic_storage_modulus", without, "Pa",
                                 say("estimate of G' without plates: storage_modulus/mean over modulus_ratio")));
    found.table.emplace_back("plates", with_unit(apart, "1") + " r0 apart, " + effect_text(ratio, between.mean(), periodic.mean()));
    if (!std::isnan(ratio)) {
        found.table.emplace_back("  without plates", "G' about " + with_unit(without, "Pa") + ": the one above over this ratio");
    }
}

}  // namespace coagula::stages
