// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: the degree of heterogeneity, from the pore-size curve.
#include <coagula/characterize/heterogeneity.hpp>

#include "measure_options.hpp"
#include "optional_results.hpp"
#include "pore_errors.hpp"

namespace coagula::characterize {

Measure doh_measure();

namespace {

constexpr double main_part = 0.1;  // P at or above which the curve is fitted the second time

/// The fitted curve at the radii of the measured one.
Eigen::VectorXd fitted_curve(const DegreeOfHeterogeneity& fit, const PoreSizes& pores, double r0) {
    Eigen::VectorXd curve(pores.radius.size());
    for (Index k = 0; k < curve.size(); ++k) {
        curve[k] = std::erfc((pores.radius[k] / r0 - fit.b) / (fit.a * std::sqrt(2.0)));
    }
    return curve;
}

/// Standard errors of a and b, and of a and b of the fit to the main part.
Eigen::VectorXd structure_errors(const PoreSizes& pores, double r0, bool has_main_part) {
    return pore_errors(pores, [&](const PoreSizes& curve) {
        const DegreeOfHeterogeneity whole = fit_degree_of_heterogeneity(curve, r0);
        const DegreeOfHeterogeneity main = has_main_part ? fit_degree_of_heterogeneity(curve, r0, main_part) : whole;
        return Eigen::VectorXd{{whole.a, whole.b, main.a, main.b}};
    });
}

MeasureResult run_doh(const MeasureInput& input) {
    const PoreSizes& pores = known_pores(input);
    const double r0 = input.r0();
    constexpr Index fewest = 6;  // radii of the main part, so that the fit has something to average
    const bool has_main_part = (pores.exclusion_probability.array() >= main_part).count() >= fewest;
    const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(pores, r0);
    const Eigen::VectorXd error = structure_errors(pores, r0, has_main_part);
    MeasureResult result;
    result.add("doh/a", fit.a, "1", "degree of heterogeneity: width of the error function fitted to the pore-size curve, over r0",
               error[0]);
    result.add("doh/b", fit.b, "1", "position of the fitted error function, over r0", error[1]);
    result.add("doh/a_stderr", fit.a_stderr, "1", "standard error of a");
    result.add("doh/b_stderr", fit.b_stderr, "1", "standard error of b");
    result.add("doh/rms_residual", fit.rms_residual, "1", "root mean square residual of the fitted probability");
    result.add_line("degree of heterogeneity a", with_error(fit.a, error[0]));
    result.add_line("position b", with_error(fit.b, error[1]));
    result.add_line("rms residual of the fit", with_unit(fit.rms_residual, "1"));
    if (has_main_part) {
        const DegreeOfHeterogeneity main = fit_degree_of_heterogeneity(pores, r0, main_part);
        result.add("doh/a_main_part", main.a, "1", "a of the fit to the part of the curve with P >= 0.1", error[2]);
        result.add("doh/b_main_part", main.b, "1", "b of the fit to the part of the curve with P >= 0.1", error[3]);
        result.add_line("a fitted to P >= 0.1 only", with_error(main.a, error[2]));
    }
    result.add_vector("pore_curve/fit", fitted_curve(fit, pores, r0), "1", "1 - erf((r/r0 - b) / (a sqrt 2))");
    return result;
}

}  // namespace

Measure doh_measure() {
    return {.name = "doh",
            .summary = "degree of heterogeneity a: width of the error function fitted to the pore-size curve",
            .run = run_doh,
            .options = {radii_option(), pore_tolerance_option()},
            .along = {"pores"}};
}

}  // namespace coagula::characterize
