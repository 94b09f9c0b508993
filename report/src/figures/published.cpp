// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_parts.hpp"
#include "published_structures.hpp"

#include <array>
#include <sstream>

namespace coagula::report {

std::vector<PublishedStructure> published_structures() {
    std::vector<PublishedStructure> rows;
    std::istringstream text(published_structures_csv);
    for (std::string line; std::getline(text, line);) {
        if (line.empty() || line.front() == '#' || line.starts_with("generator")) {
            continue;
        }
        std::array<std::string, 7> field;
        std::istringstream fields(line);
        for (std::string& word : field) {
            std::getline(fields, word, ',');
        }
        rows.push_back(
            {field[0], std::stod(field[1]), std::stod(field[3]), std::stod(field[4]), std::stod(field[5]), std::stod(field[6])});
    }
    return rows;
}

std::vector<Series> published_series(double (*x)(const PublishedStructure&), double (*y)(const PublishedStructure&),
                                     double (*error)(const PublishedStructure&)) {
    Series vem{.name = "published VEM", .mark = Mark::open_points, .colour = 0};
    Series brownian{.name = "published BD", .mark = Mark::open_points, .colour = 1};
    for (const PublishedStructure& row : published_structures()) {
        Series& series = row.generator == "vem" ? vem : brownian;
        series.x.push_back(x(row));
        series.y.push_back(y(row));
        if (error != nullptr) {
            series.error.push_back(error(row));
        }
    }
    return {vem, brownian};
}

}  // namespace coagula::report
