// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: common-neighbour analysis.
#include <coagula/characterize/local_structure.hpp>

#include "measure_options.hpp"
#include "optional_results.hpp"

namespace coagula::characterize {

Measure common_neighbours_measure();

namespace {

/// One row per signature: common neighbours, contacts among them, contacts of the largest connected set, fraction of the contacts.
Eigen::MatrixXd table_of(const CommonNeighbours& found) {
    Eigen::MatrixXd table(std::ssize(found.fraction), 4);
    Index row = 0;
    for (const auto& [signature, fraction] : found.fraction) {
        table.row(row++) << signature[0], signature[1], signature[2], fraction;
    }
    return table;
}

MeasureResult run_common_neighbours(const MeasureInput& input) {
    const CommonNeighbours found =
        measure_common_neighbours(input.packing(), {.contact_tolerance = input.number("contact-tolerance")});
    MeasureResult result;
    if (!found.fraction.empty()) {
        result.add_matrix(
            "common_neighbours/signatures", table_of(found), "1",
            "rows: common neighbours of a contact, contacts among these, contacts of their largest connected set, fraction "
            "of all contacts");
    }
    result.add("common_neighbours/mean", found.mean, "1", "mean number of common neighbours of a contact", found.mean_stderr);
    const std::string meaning = "fraction of particles with such surroundings (adaptive common-neighbour analysis)";
    result.add("common_neighbours/fcc", found.fcc, "1", meaning, found.fcc_stderr);
    result.add("common_neighbours/hcp", found.hcp, "1", meaning, found.hcp_stderr);
    result.add("common_neighbours/bcc", found.bcc, "1", meaning, found.bcc_stderr);
    result.add("common_neighbours/icosahedral", found.icosahedral, "1", meaning, found.icosahedral_stderr);
    result.add_line("common neighbours", with_unit(found.mean, "1") + " of a contact; fcc " + with_unit(100 * found.fcc, "%") +
                                             ", hcp " + with_unit(100 * found.hcp, "%") + ", bcc " +
                                             with_unit(100 * found.bcc, "%") + ", icosahedral " +
                                             with_unit(100 * found.icosahedral, "%"));
    return result;
}

}  // namespace

Measure common_neighbours_measure() {
    return {.name = "common_neighbours",
            .summary = "common neighbours of contacts; particles in fcc, hcp, bcc and icosahedral order",
            .run = run_common_neighbours,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
