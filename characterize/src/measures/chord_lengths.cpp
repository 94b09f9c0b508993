// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: chord lengths.
#include <coagula/characterize/chord_lengths.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure chord_lengths_measure();

namespace {

void add_phase(const ChordDistribution& found, const std::string& phase, MeasureResult& result) {
    const std::string name = "chord_lengths/" + phase;
    const std::string of = " of the chords in the " + phase;
    result.add_vector(name + "/length", found.length, "m", "middle of the bins of the length" + of);
    result.add_vector(name + "/density", found.density, "m-1", "probability density of the length" + of);
    result.add(name + "/mean", found.mean, "m", "mean length" + of, found.mean_stderr);
    result.add(name + "/second_moment", found.second_moment, "m2", "mean square of the length" + of, found.second_moment_stderr);
    add_known(result, name + "/mean_by_axis", Eigen::VectorXd(found.mean_by_axis), "m", "mean length" + of + " along x, y, z");
    add_known(result, name + "/mean_by_axis_stderr", Eigen::VectorXd(found.stderr_by_axis), "m", "standard errors of mean_by_axis");
    result.add_count(name + "/chords", found.chords, "number" + of);
}

MeasureResult run_chord_lengths(const MeasureInput& input) {
    const ChordLengths found = if_applicable(
        [&] { return measure_chord_lengths(input.packing(), {.lines = input.count("chord-lines")}, input.progress()); });
    MeasureResult result;
    add_phase(found.voids, "void", result);
    add_phase(found.solid, "solid", result);
    result.add_line("mean chord", with_unit(found.voids.mean / input.r0(), "r0") + " in the void, " +
                                      with_unit(found.solid.mean / input.r0(), "r0") + " in the spheres");
    return result;
}

}  // namespace

Measure chord_lengths_measure() {
    return {.name = "chord_lengths",
            .summary = "chord lengths: lengths of the pieces of straight lines in the void and in the spheres",
            .run = run_chord_lengths,
            .options = {{"chord-lines", "", "number of lines of the chord lengths along each axis", 3000, 1, 1e8}}};
}

}  // namespace coagula::characterize
