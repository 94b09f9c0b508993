#include <coagula/mechanics/stiffness_series.hpp>

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
        series.modulus[k] = response.mean_shear_modulus();
        series.modulus_deviation[k] = response.shear_modulus_deviation();
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
