// Measure: the degree of heterogeneity, from the pore-size curve.
#include <coagula/characterize/heterogeneity.hpp>

#include "measure_options.hpp"

namespace coagula::characterize {

Measure doh_measure();

namespace {

/// The fitted curve at the radii of the measured one.
Eigen::VectorXd fitted_curve(const DegreeOfHeterogeneity& fit, const PoreSizes& pores, double r0) {
    Eigen::VectorXd curve(pores.radius.size());
    for (Index k = 0; k < curve.size(); ++k) {
        curve[k] = std::erfc((pores.radius[k] / r0 - fit.b) / (fit.a * std::sqrt(2.0)));
    }
    return curve;
}

MeasureResult run(const MeasureInput& input) {
    const PoreSizes& pores = input.pores();
    const DegreeOfHeterogeneity fit = fit_degree_of_heterogeneity(pores, input.r0());
    MeasureResult result;
    result.add("doh/a", fit.a, "1", "degree of heterogeneity: width of the error function fitted to the pore-size curve, over r0");
    result.add("doh/b", fit.b, "1", "position of the fitted error function, over r0");
    result.add("doh/a_stderr", fit.a_stderr, "1", "standard error of a");
    result.add("doh/b_stderr", fit.b_stderr, "1", "standard error of b");
    result.add("doh/rms_residual", fit.rms_residual, "1", "root mean square residual of the fitted probability");
    result.add_vector("pore_curve/fit", fitted_curve(fit, pores, input.r0()), "1", "1 - erf((r/r0 - b) / (a sqrt 2))");
    result.add_line("degree of heterogeneity a", with_error(fit.a, fit.a_stderr));
    result.add_line("position b", with_error(fit.b, fit.b_stderr));
    result.add_line("rms residual of the fit", with_unit(fit.rms_residual, "1"));
    return result;
}

}  // namespace

Measure doh_measure() {
    return {.name = "doh",
            .summary = "degree of heterogeneity a: width of the error function fitted to the pore-size curve",
            .run = run,
            .options = {radii_option(), pore_tolerance_option()},
            .along = {"pores"}};
}

}  // namespace coagula::characterize
