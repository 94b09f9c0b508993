// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanisms.hpp"

namespace coagula::diagnose::mechanisms {

namespace {

/// The loss acts from a place among the rows on, to the last run on that sample. At least three rows of the sample lie before it
/// and three behind it: one or two that differ are outliers.
std::complex<double> lost(std::complex<double> modulus, const Observation& row, Values values) {
    const bool is_loss = row.third_place <= values[0] && values[0] < row.last_third_place;
    return is_loss && !is<Viscosity>(row) && row.place > values[0] ? modulus * values[1] : modulus;
}

/// In fewer rows a step is a few outliers.
bool has_many_rows(const Measurement& table) {
    constexpr std::size_t enough = 8;
    return table.rows() >= enough &&
           (find_column(table, "storage_modulus") != nullptr || find_column(table, "loss_modulus") != nullptr);
}

/// The strain grows from row to row.
bool only_strains_more(const Measurement& table) {
    const Column* strain = find_column(table, "strain");
    return strain != nullptr && varies(table, "strain") && std::is_sorted(strain->values.begin(), strain->values.end());
}

/// What gives way while the strain grows may have yielded: networks have a law for that, a material without a model has none.
bool is_told_from_yielding(const Knows& knows) {
    if (knows.experiment.material.kind != MaterialKind::smooth) {
        return any_measurement(knows.experiment, has_many_rows);
    }
    return any_measurement(knows.experiment,
                           [](const Measurement& table) { return has_many_rows(table) && !only_strains_more(table); });
}

}  // namespace

/// A crack along which the sample slips, a bubble that escapes and a plate that was touched all have this effect.
Mechanism sudden_loss() {
    return {.name = "sudden-loss",
            .term = "during a run a sample suddenly loses part of its grip on the plates, or part of its material",
            .signature =
                "From one row on, all moduli of one sample are lower by one factor, whatever is varied. Its later "
                "runs show the same factor; other samples do not.",
            .kind = {Link::geometry, Axis::time},
            .parameters = {{"place_of_loss", "1", 0, 1, false}, {"remaining_share", "1", 0.05, 0.99, false}},
            .effect = ChangesGeometry{lost},
            .applies = is_told_from_yielding};
}

}  // namespace coagula::diagnose::mechanisms
