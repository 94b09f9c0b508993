// Measure: overlaps of the spheres.
#include <coagula/characterize/measure.hpp>

namespace coagula::characterize {

Measure overlap_measure();

namespace {

MeasureResult run(const MeasureInput& input) {
    const Overlaps overlaps = measure_overlaps(input.packing());
    MeasureResult result;
    result.add("overlap/mean", overlaps.mean, "1", "mean overlap of the overlapping pairs over r_i + r_j");
    result.add("overlap/rms", overlaps.rms, "1", "root mean square overlap of the overlapping pairs over r_i + r_j");
    result.add("overlap/max", overlaps.max, "1", "largest overlap over r_i + r_j");
    result.add_count("overlap/pairs", overlaps.pairs, "number of overlapping pairs");
    result.add("overlap/implied_noise", overlaps.implied_noise, "m",
               "error of a coordinate that would explain the overlaps of spheres that just touch: rms overlap / sqrt(2)");
    result.add_line("overlap", with_unit(100 * overlaps.rms, "%") + " rms, " + with_unit(100 * overlaps.max, "%") +
                                   " max of the diameter, " + std::to_string(overlaps.pairs) + " pairs");
    return result;
}

}  // namespace

Measure overlap_measure() {
    return {.name = "overlap", .summary = "overlaps of touching spheres", .run = run};
}

}  // namespace coagula::characterize
