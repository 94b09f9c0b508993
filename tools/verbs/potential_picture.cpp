// SPDX-License-Identifier: GPL-3.0-or-later
#include "potential_picture.hpp"

#include <coagula/io/atomic_file.hpp>
#include <coagula/report/chart.hpp>

#include <algorithm>

namespace coagula::tools {

void check_picture_name(const std::string& path) {
    report::picture_format(path, "--picture");
}

void draw_potential(const std::string& path, const PotentialCurve& curve, bool overwrite) {
    // The wells of elastic contacts are far deeper than all else: the picture shows what lies above the secondary minimum. An
    // attraction with a well of its own is shown whole.
    double highest = 1;
    double lowest = curve.logarithmic ? -10 : 0;
    for (const double energy : curve.energy) {
        highest = std::max(highest, energy);
        lowest = curve.logarithmic ? lowest : std::min(lowest, 1.1 * energy);
    }
    const report::Chart chart{.x = {.name = "gap {/:Italic h}", .plain = "gap", .unit = "m", .logarithmic = curve.logarithmic},
                              .y = {.name = "energy {/:Italic U} / {/:Italic k}_B{/:Italic T}",
                                    .plain = "energy over kB T",
                                    .low = lowest,
                                    .high = 1.1 * highest},
                              .series = {{.x = curve.gap, .y = curve.energy, .mark = report::Mark::line}}};
    const report::Drawing drawing{.panels = {chart}, .caption = ""};
    io::write_file(path, report::draw(drawing, report::picture_format(path, "--picture"), report::default_size(drawing)),
                   overwrite);
}

}  // namespace coagula::tools
