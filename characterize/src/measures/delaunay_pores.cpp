// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: spheres between four neighbours and the throats between them.
#include "inner_sums.hpp"
#include "optional_results.hpp"
#include "pores/pores_of_diagram.hpp"

namespace coagula::characterize {

Measure delaunay_pores_measure();

namespace {

constexpr Index radii = 100;

/// Mean and standard deviation of R, then of t, and throats per particle; from the sums of DelaunayPores.
Eigen::VectorXd moments(const Eigen::VectorXd& sums) {
    const auto deviation = [&](Index row) {
        const double mean = sums[row + 1] / sums[row];
        return std::sqrt(std::max(0.0, sums[row + 2] / sums[row] - mean * mean));
    };
    return Eigen::VectorXd{{sums[2] / sums[1], deviation(1), sums[5] / sums[4], deviation(4), sums[4] / sums[0]}};
}

MeasureResult run_delaunay_pores(const MeasureInput& input) {
    const DelaunayPores pores = if_applicable([&] { return measure_delaunay_pores(input.diagram(), radii); });
    const Eigen::VectorXd found = moments(sum_inner(input, pores.by_particle));
    const Eigen::VectorXd error = errors_of_means(input, pores.by_particle, moments);
    const double r0 = input.r0();
    MeasureResult result;
    result.add("delaunay_pores/circumsphere_mean", found[0] / r0, "1",
               "mean radius over r0 of the spheres that touch four neighbours, weighted by the volume of the tetrahedra",
               error[0] / r0);
    result.add("delaunay_pores/circumsphere_spread", found[1] / r0, "1", "their standard deviation over r0", error[1] / r0);
    add_known(result, "delaunay_pores/throat_mean", found[2] / r0, "1",
              "mean radius over r0 of the narrowest places between two such spheres", error[2] / r0);
    add_known(result, "delaunay_pores/throat_spread", found[3] / r0, "1", "their standard deviation over r0", error[3] / r0);
    result.add("delaunay_pores/throats_per_particle", found[4], "1", "number of such places per particle", error[4]);
    result.add_vector("delaunay_pores/radius", pores.radius, "m", "radius r");
    result.add_vector("delaunay_pores/circumspheres", pores.circumspheres, "1",
                      "fraction of the volume of the tetrahedra whose sphere has a radius above r");
    result.add_vector("delaunay_pores/throats", pores.throats, "1", "fraction of the throats with a radius above r");
    result.add_line("Delaunay pores",
                    "mean radius " + with_error(found[0] / r0, error[0] / r0) + " r0: spheres that touch four neighbours");
    result.add_line("throats between them", "mean radius " + with_error(found[2] / r0, error[2] / r0) + " r0, " +
                                                with_error(found[4], error[4]) + " per particle");
    return result;
}

}  // namespace

Measure delaunay_pores_measure() {
    return {.name = "delaunay_pores",
            .summary = "spheres that touch four neighbours (Delaunay circumspheres), and the throats between them",
            .run = run_delaunay_pores};
}

}  // namespace coagula::characterize
