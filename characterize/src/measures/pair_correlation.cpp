// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the pair correlation function.
#include <coagula/characterize/pair_correlation.hpp>

#include "measure_options.hpp"
#include "optional_results.hpp"

namespace coagula::characterize {

Measure pair_correlation_measure();

namespace {

void add_distribution(const RadialDistribution& found, const std::string& name, const std::string& unit, const std::string& of,
                      MeasureResult& result) {
    result.add_vector(name + "/lower", found.lower, unit, "lower edges of the bins of " + of);
    result.add_vector(name + "/upper", found.upper, unit, "upper edges of the bins of " + of);
    result.add_vector(name + "/distance", (found.lower + found.upper) / 2, unit, "middles of the bins of " + of);
    result.add_vector(name + "/g", found.g, "1", "pairs in the bin over those of an ideal gas");
    add_known(result, name + "/g_stderr", found.g_stderr, "1", "standard error of g from sub-volumes");
    result.add_vector(name + "/neighbours", found.neighbours, "1", "mean number of particles nearer than the upper edge");
}

/// Standard error of the number density [m-3], from the Voronoi cells of the inner particles; of a periodic packing it is a fact.
double density_error(const MeasureInput& input) {
    const Eigen::VectorXd& volumes = input.voronoi_cells().volumes;
    Eigen::MatrixXd values(2, volumes.size());
    values << Eigen::RowVectorXd::Ones(volumes.size()), volumes.transpose();
    const auto density = [](const Eigen::VectorXd& sum) { return Eigen::VectorXd::Constant(1, sum[0] / sum[1]); };
    return input.packing().cell.is_periodic() ? 0.0 : block_errors(sum_by_block(input.blocks(), values), density)[0];
}

MeasureResult run_pair_correlation(const MeasureInput& input) {
    const auto measure = [&] {
        return measure_pair_correlation(input.packing(), {.range = input.has("pair-range") ? input.number("pair-range") : unset,
                                                          .bin_width = input.number("pair-bin")});
    };
    const PairCorrelation found =
        input.given("pair-range") ? measure() : if_applicable(measure);  // a range that does not fit is an error
    MeasureResult result;
    add_distribution(found.by_distance, "pair_correlation", "m", "the distance of centres", result);
    if (!is_monodisperse(input.packing())) {
        add_distribution(found.by_contact, "pair_correlation/by_contact", "1", "the distance of centres over r_i + r_j", result);
    }
    add_known(result, "pair_correlation/contact_peak", found.contact_peak, "1",
              "mean number of neighbours in the bin of the contacts", found.contact_peak_stderr);
    add_known(result, "pair_correlation/contact_value", found.contact_value, "1",
              "g at r_i + r_j, extrapolated from outside the bin of the contacts", found.contact_value_stderr);
    result.add("pair_correlation/number_density", found.number_density, "m-3", "particles per volume", density_error(input));
    result.add_count("pair_correlation/centres", found.centres, "particles around which neighbours were counted");
    if (std::isfinite(found.contact_peak)) {
        result.add_line("contact peak of g(r)", with_unit(found.contact_peak, "1") + " neighbours");
    }
    return result;
}

}  // namespace

Measure pair_correlation_measure() {
    return {.name = "pair_correlation",
            .summary = "pair correlation function g(r), with the contacts in a bin of their own",
            .run = run_pair_correlation,
            .options = {{"pair-range", "m", "largest distance of g(r); default: half the box, at most 12 mean diameters", {}, 0},
                        {"pair-bin", "1", "width of the bins of g(r) in mean diameters", 0.05, 0.01, 1}}};
}

}  // namespace coagula::characterize
