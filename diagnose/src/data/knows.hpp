// SPDX-License-Identifier: GPL-3.0-or-later
// This header tells what an experiment knows and varies; which causes can show in it follows from that.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include "table_cells.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace coagula::diagnose {

/// A flag is true where the sample or the instrument states the quantity, or where a table shows it.
struct Knows {
    const Experiment& experiment;
    bool moduli;        ///< moduli or viscosities
    bool frequency;     ///< of oscillations
    bool strain;        ///< amplitude of oscillations
    bool flow;          ///< viscosities in steady flow
    bool clock;         ///< when moduli or viscosities were measured, one after the other
    bool shear_before;  ///< every run follows a shear that destroyed the structure, or some does
    bool load;          ///< the normal force in every row of every oscillation on the sample, not the same in all
    bool gap;           ///< of the plates
    bool walls;         ///< their distance: between plates, or under a cone of known angle and radius
    bool radius;        ///< of plates with a rim
    bool torque;        ///< torque per angle over the modulus
    bool geometry;      ///< what changes every row alike: of a material without a model, where tables differ in gap or plate
    bool level;         ///< the modulus that particles or an oil should have, and not its course alone
    bool recipe;        ///< structures that can be made again, and what they look like, or how stiff they are with known contacts
};
Knows knowledge_of(const Experiment& experiment);

template <class Holds>
bool any_measurement(const Experiment& experiment, const Holds& holds) {
    return std::any_of(experiment.measurements.begin(), experiment.measurements.end(), holds);
}

/// Whether what `of_row` says of the rows of all tables differs by more than a twentieth.
template <class OfRow>
bool differs(const Experiment& experiment, const OfRow& of_row) {
    std::set<double> all;
    for (const Measurement& table : experiment.measurements) {
        for (std::size_t row = 0; row < table.rows(); ++row) {
            if (const double value = of_row(table, row); std::isfinite(value)) {
                all.insert(value);
            }
        }
    }
    return !all.empty() && *all.rbegin() > 1.05 * *all.begin();
}

/// The same of a column.
inline bool column_differs(const Experiment& experiment, std::string_view column) {
    return differs(experiment, [&](const Measurement& table, std::size_t row) { return cell(table, column, row); });
}

/// Whether an oil of known viscosity was measured beside the sample.
inline bool has_oil(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) { return std::isfinite(table.fluid_viscosity); });
}

inline bool has_trap(const Experiment& experiment) {
    return any_measurement(experiment, [](const Measurement& table) { return table.solvent_trap; });
}

/// Whether a column of a table varies by more than a twentieth.
bool varies(const Measurement& table, std::string_view name);

}  // namespace coagula::diagnose
