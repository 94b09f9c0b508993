// SPDX-License-Identifier: GPL-3.0-or-later
#include "diagnosis_tables.hpp"

#include "html.hpp"

#include <coagula/diagnose/observable.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace coagula::report {

std::string conditions_of(const diagnose::Measurement& table) {
    std::string text = std::string(diagnose::name_of(table.kind)) + " · sample " + table.sample;
    if (table.rough_plates) {
        text += " · between rough plates";
    }
    if (table.solvent_trap) {
        text += " · under a solvent trap";
    }
    if (std::isfinite(table.cone_angle)) {
        text += " · under a cone of " + printed(table.cone_angle * 180 / std::numbers::pi) + "°";
    }
    if (std::isfinite(table.fluid_viscosity)) {
        text += " · a Newtonian fluid of " + printed(table.fluid_viscosity, "Pa.s") + " in place of the sample";
    }
    if (table.oscillations > 1) {
        text += " · the last of " + std::to_string(table.oscillations) + " oscillations a row";
    }
    return text;
}

std::string image_table(const diagnose::Diagnosis& diagnosis, std::size_t number, const std::string& cause) {
    std::vector<std::vector<std::string>> rows;
    for (const std::string observable : {"localisation_plane", "localisation_axis", "unmatched_share"}) {
        const std::string words(diagnose::observable_named(observable).symbol);
        for (const diagnose::PredictedRow& row : diagnosis.rows) {
            if (row.measurement == number && row.observable == observable) {
                rows.push_back({words, printed(row.measured) + " ± " + printed(row.standard_deviation), printed(row.base)});
                if (!cause.empty()) {
                    rows.back().push_back(printed(row.extended));
                }
            }
        }
    }
    std::vector<std::string> head{"images of the same particles", "measured", "base model"};
    if (!cause.empty()) {
        head.push_back("with " + escaped(cause));
    }
    return rows.empty() ? std::string{} : html_table(head, rows);
}

}  // namespace coagula::report
