// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the structure factor.
#include <coagula/characterize/structure_factor.hpp>

#include "optional_results.hpp"

namespace coagula::characterize {

Measure structure_factor_measure();

namespace {

MeasureResult run_structure_factor(const MeasureInput& input) {
    const StructureFactor found =
        if_applicable([&] { return measure_structure_factor(input.packing(), {.largest = input.number("largest-wave-number")}); });
    MeasureResult result;
    result.add_vector("structure_factor/wave_number", found.wave_number, "m-1", "mean wave number q of each shell of wave vectors");
    result.add_vector("structure_factor/direct", found.direct, "1",
                      "S(q) = |sum_j exp(i q x_j)|^2 / N over the wave vectors of the shell");
    result.add_vector("structure_factor/direct_stderr", found.direct_stderr, "1",
                      "standard error of direct, from the vectors of the shell");
    add_known(result, "structure_factor/transformed", found.transformed, "1", "S(q) by the transform of the pair correlation");
    add_known(result, "structure_factor/transformed_error", found.transformed_error, "1",
              "error of transformed: counting, and the window that ends the transform");
    result.add_counts("structure_factor/vectors", found.vectors, "number of wave vectors used in each shell");
    add_known(result, "structure_factor/at_zero", found.at_zero, "1", "S(0), extrapolated by S(0) + b q^2 + c q^4",
              found.at_zero_stderr);
    result.add("structure_factor/peak", found.peak, "1", "largest S(q)", found.peak_stderr);
    result.add("structure_factor/peak_wave_number", found.peak_wave_number, "m-1", "q of the largest S(q)",
               found.peak_wave_number_stderr);
    result.add_line("structure factor",
                    "largest " + with_unit(found.peak, "1") +
                        " at q = " + with_unit(2 * input.r0() * found.peak_wave_number, "/ diameter") +
                        (std::isfinite(found.at_zero) ? ", S(0) " + with_error(found.at_zero, found.at_zero_stderr) : ""));
    return result;
}

}  // namespace

Measure structure_factor_measure() {
    return {.name = "structure_factor",
            .summary = "structure factor S(q), from wave vectors and from g(r), and S(0)",
            .run = run_structure_factor,
            .options = {{"largest-wave-number", "1", "largest q of S(q), times the mean diameter", 25, 1, 100}}};
}

}  // namespace coagula::characterize
