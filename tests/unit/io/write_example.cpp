// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a small structure file for check_readers.py: write_example FILE.h5 FILE.json (the numbers that readers must find).
#include <coagula/io/structure_file.hpp>

#include <nlohmann/json.hpp>

#include <fstream>

#include "example_packing.hpp"

namespace {

using namespace coagula;

nlohmann::json columns_json(const Eigen::MatrixXd& values) {
    nlohmann::json rows = nlohmann::json::array();
    for (Index i = 0; i < values.cols(); ++i) {
        rows.push_back(std::vector<double>(values.col(i).begin(), values.col(i).end()));
    }
    return rows;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): the test sees how it ends
int main(int /*count*/, char** arguments) {
    const Packing packing = io::example_packing(300, true);
    const ContactNetwork bonds = find_contacts(packing, 0.2);
    const Eigen::Matrix3Xd field = 2.0 * packing.positions;
    io::write_structure(arguments[1], {packing, bonds}, {{"doubled_position", field, "m", "twice the position"}},
                        {io::scalar("/mechanics/linear/modulus", 1.5e6, "Pa", "a modulus"),
                         io::matrix("/mechanics/linear/matrix", Eigen::Matrix2d{{1, 2}, {3, 4}}, "Pa", "a matrix")},
                        {"generate test", "coagula test", "{}", 7, "0", "2000-01-01T00:00:00Z", 0.5, ""}, true);
    nlohmann::json expected;
    expected["positions_m"] = columns_json(packing.positions);
    expected["radii_m"] = std::vector<double>(packing.radii.begin(), packing.radii.end());
    expected["box_m"] = std::vector<double>{packing.cell.lengths()[0], packing.cell.lengths()[1], packing.cell.lengths()[2]};
    expected["bonds"] = columns_json(bonds.ends.cast<double>());
    expected["branch_m"] = columns_json(bonds.branch);
    expected["positions_sha256"] = io::positions_sha256(packing);
    std::ofstream(arguments[2]) << expected;
}
