// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/stiffness_series.hpp>

#include <cmath>
#include <string>

namespace coagula::mechanics {

namespace {

void check_series(const StiffnessSeriesOptions& options) {
    const Eigen::VectorXd& stiffness = options.normal_stiffness;
    require(stiffness.size() >= 2,
            "a stiffness series needs at least two stiffnesses, but there are " + std::to_string(stiffness.size()));
    for (Index k = 0; k < stiffness.size(); ++k) {
        require_positive(stiffness[k], "a stiffness of the series", "N/m");
        require(k == 0 || stiffness[k] > stiffness[k - 1], "the stiffnesses of a series must rise, but " + to_text(stiffness[k]) +
                                                               " N/m follows " + to_text(stiffness[k > 0 ? k - 1 : 0]) + " N/m");
    }
    require_positive(options.stiffness_ratio, "the ratio of normal to shear stiffness");
    require(options.linear.bond_tangents.empty(),
            "a stiffness series varies the stiffness of all particles alike: the bonds must have no tangents of their own");
}

struct Moduli {
    double mean;
    double deviation;
};

/// Shear modulus by the method that is asked for, as mean over the six orientations and standard deviation.
Moduli find_moduli(const Packing& packing, const ContactNetwork& bonds, const StiffnessSeriesOptions& options,
                   const LinearResponse& linear, const ContactModel& springs, const Progress& progress) {
    if (options.method == SeriesMethod::quasistatic) {
        const auto moduli = small_strain_moduli(packing, bonds, springs, options.strain, options.quasistatic, progress);
        const auto values = Eigen::ArrayXd::Map(moduli.data(), static_cast<Index>(moduli.size()));
        return {values.mean(), std::sqrt((values - values.mean()).square().mean())};
    }
    if (options.method == SeriesMethod::dem) {
        RheometerOptions rheometer = options.rheometer;
        rheometer.model = springs;
        const auto orientations = all_orientations();
        const RheometerResult result =
            run_rheometer(packing, bonds, rheometer, {orientations.begin(), orientations.end()}, progress);
        return {result.storage_modulus(), result.storage_deviation()};
    }
    return {linear.mean_shear_modulus(), linear.shear_modulus_deviation()};
}

}  // namespace

StiffnessSeries measure_stiffness_series(const Packing& packing, const ContactNetwork& bonds, const StiffnessSeriesOptions& options,
                                         const Progress& progress) {
    check_series(options);
    const Index count = options.normal_stiffness.size();
    StiffnessSeries series;
    series.normal_stiffness = options.normal_stiffness;
    series.shear_stiffness = options.normal_stiffness / options.stiffness_ratio;
    series.modulus.resize(count);
    series.modulus_deviation.resize(count);
    LinearOptions linear = options.linear;
    for (Index k = 0; k < count; ++k) {
        const Progress part([&](std::string_view, double fraction, std::string_view remark) {
            progress.update("stiffness series", (static_cast<double>(k) + fraction) / static_cast<double>(count), remark);
            return true;
        });
        linear.normal_stiffness = series.normal_stiffness[k];
        linear.shear_stiffness = series.shear_stiffness[k];
        const LinearResponse response = solve_linear(packing, bonds, linear, part);
        const ContactModel springs{.normal_stiffness = linear.normal_stiffness, .shear_stiffness = linear.shear_stiffness};
        const Moduli moduli = find_moduli(packing, bonds, options, response, springs, part);
        series.modulus[k] = moduli.mean;
        series.modulus_deviation[k] = moduli.deviation;
        series.carries_shear = response.mean_shear_modulus() > 1e-8 * response.mean_affine_modulus();
        series.contacts = response.contacts;
        series.rattlers = response.rattlers;
    }
    series.line = fit_line(series.normal_stiffness, series.modulus);
    series.line_through_origin = fit_line_through_origin(series.normal_stiffness, series.modulus);
    progress.update("stiffness series", 1.0);
    return series;
}

StiffnessCalibration calibrate_stiffness(const Eigen::VectorXd& slope, const Eigen::VectorXd& measured) {
    require(slope.size() == measured.size() && slope.size() > 0, "there are " + std::to_string(measured.size()) +
                                                                     " measured moduli for " + std::to_string(slope.size()) +
                                                                     " structures: each structure needs one");
    for (Index k = 0; k < slope.size(); ++k) {
        const std::string structure = " of structure " + std::to_string(k + 1);
        require_positive(slope[k], "the modulus over the stiffness" + structure, "1/m");
        require_positive(measured[k], "the measured modulus" + structure, "Pa");
    }
    StiffnessCalibration found;
    found.matching = measured.cwiseQuotient(slope);
    const StraightLine line = fit_line_through_origin(slope, measured);
    found.common = line.slope;
    found.common_stderr = line.slope_stderr;
    found.modulus_at_common = found.common * slope;
    found.difference_at_common = (found.modulus_at_common - measured).cwiseQuotient(measured);
    return found;
}

}  // namespace coagula::mechanics
