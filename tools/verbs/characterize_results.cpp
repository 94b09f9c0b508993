#include "characterize_results.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace coagula::tools {

namespace {

using characterize::PoreSizes;

const std::string group = "/characterization/";

/// Of an open packing only the inner part has a volume: that of the Voronoi cells that were measured.
double representative_volume_fraction(const Characterization& found, const Packing& packing) {
    return packing.cell.is_periodic() || !found.pores ? volume_fraction(packing) : 1 - found.pores->void_fraction;
}

std::string volume_fraction_description(const Characterization& found, const Packing& packing) {
    if (packing.cell.is_periodic()) {
        return "solid volume over the volume of the box";
    }
    return found.pores ? "solid volume over volume in the inner Voronoi cells"
                       : "solid volume over the volume of the enclosing box";
}

void append_packing(Results& results, const Characterization& found, const Packing& packing) {
    results.push_back(io::integer(group + "particles", packing.size(), "number of particles"));
    results.push_back(io::scalar(group + "volume_fraction", representative_volume_fraction(found, packing), "1",
                                 volume_fraction_description(found, packing)));
    results.push_back(io::vector(group + "box", packing.cell.lengths(), "m", "edge lengths of the box"));
    results.push_back(io::scalar(group + "mean_radius", mean_radius(packing), "m", "r0, by which reduced lengths are divided"));
}

void append_coordination(Results& results, const characterize::Coordination& coordination, double tolerance) {
    const auto add = [&results](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(group + name, value, "1", description));
    };
    const bool has_surface = coordination.inner_particles < coordination.contacts.particles;
    add("coordination", coordination.mean,
        std::string("mean number of contacts of ") + (has_surface ? "an inner particle" : "a particle") + ", rattlers included");
    if (has_surface) {
        results.push_back(io::integer(group + "inner_particles", coordination.inner_particles,
                                      "particles that no neighbour beyond the free surface could touch: the means are over these"));
        add("coordination_all", coordination.mean_all, "mean number of contacts of a particle, those at the free surface included");
    }
    add("contact_tolerance", tolerance, "pairs nearer than (1 + tolerance) (r_i + r_j) are in contact");
    add("coordination_without_rattlers", coordination.mean_without_rattlers, "contacts among the other particles, per particle");
    add("rattler_fraction", coordination.rattler_fraction,
        "fraction of particles left with fewer than two contacts when such particles are removed again and again");
    add("below_three_fraction", coordination.below_three_fraction, "fraction of the particles with fewer than three contacts");
    results.push_back(io::integer(group + "contacts", coordination.contacts.size(), "number of contacts"));
    results.push_back(
        io::integers(group + "coordination_histogram", coordination.histogram, "number of particles with 0, 1, 2 ... contacts"));
}

void append_overlaps(Results& results, const characterize::Overlaps& overlaps) {
    const auto add = [&results](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(group + "overlap/" + name, value, "1", description));
    };
    add("mean", overlaps.mean, "mean overlap of the overlapping pairs over r_i + r_j");
    add("rms", overlaps.rms, "root mean square overlap of the overlapping pairs over r_i + r_j");
    add("max", overlaps.max, "largest overlap over r_i + r_j");
    results.push_back(io::integer(group + "overlap/pairs", overlaps.pairs, "number of overlapping pairs"));
}

void append_pore_sizes(Results& results, const PoreSizes& pores, double r0) {
    const auto add = [&results](const std::string& name, double value, const std::string& unit, const std::string& description) {
        results.push_back(io::scalar(group + name, value, unit, description));
    };
    add("pore_size/mean", pores.mean / r0, "1", "mean pore radius over r0");
    add("pore_size/second_moment", pores.second_moment / (r0 * r0), "1", "mean square of the pore radius over r0^2");
    add("pore_size/median", pores.median / r0, "1", "median pore radius over r0");
    add("pore_size/max", pores.max / r0, "1", "radius of the largest pore over r0");
    add("pore_size/mean_m", pores.mean, "m", "mean pore radius");
    add("pore_size/second_moment_m2", pores.second_moment, "m2", "mean square of the pore radius");
    add("pore_size/median_m", pores.median, "m", "median pore radius");
    add("pore_size/max_m", pores.max, "m", "radius of the largest pore");
    add("pore_space/void_fraction", pores.void_fraction, "1", "void volume over the volume measured");
    add("pore_space/volume", pores.volume, "m3",
        "volume measured: the periodic box, or the inner Voronoi cells of an open packing");
    results.push_back(
        io::integer(group + "pore_space/inner_particles", pores.inner_particles, "particles whose Voronoi cells were measured"));
    if (std::isfinite(pores.cell_volume_defect)) {
        add("pore_space/cell_volume_defect", pores.cell_volume_defect, "1", "|sum of the Voronoi cell volumes / box volume - 1|");
    }
    results.push_back(io::vector(group + "pore_curve/radius", pores.radius, "m", "radius r"));
    results.push_back(io::vector(group + "pore_curve/exclusion_probability", pores.exclusion_probability, "1",
                                 "P(r_P > r): probability that a point of the void space is farther than r from every surface"));
}

/// The fitted curve at the radii of the measured one.
Eigen::VectorXd fitted_curve(const characterize::DegreeOfHeterogeneity& fit, const PoreSizes& pores, double r0) {
    Eigen::VectorXd curve(pores.radius.size());
    for (Index k = 0; k < curve.size(); ++k) {
        curve[k] = std::erfc((pores.radius[k] / r0 - fit.b) / (fit.a * std::sqrt(2.0)));
    }
    return curve;
}

void append_heterogeneity(Results& results, const characterize::DegreeOfHeterogeneity& fit, const PoreSizes& pores, double r0) {
    const auto add = [&results](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(group + "doh/" + name, value, "1", description));
    };
    add("a", fit.a, "degree of heterogeneity: width of the error function fitted to the pore-size curve, over r0");
    add("b", fit.b, "position of the fitted error function, over r0");
    add("a_stderr", fit.a_stderr, "standard error of a");
    add("b_stderr", fit.b_stderr, "standard error of b");
    add("rms_residual", fit.rms_residual, "root mean square residual of the fitted probability");
    results.push_back(io::vector(group + "pore_curve/fit", fitted_curve(fit, pores, r0), "1", "1 - erf((r/r0 - b) / (a sqrt 2))"));
}

void append_check(Results& results, const SampledCheck& check) {
    const std::string place = group + "sampled_check/";
    results.push_back(io::scalar(place + "largest_z", check.largest_z, "1",
                                 "largest |sampled - exact| exclusion probability over its standard error"));
    results.push_back(io::integer(place + "radii", check.radii, "number of radii compared"));
    results.push_back(io::integer(place + "void_points", check.sampled.void_points, "random points that fell into the void space"));
    results.push_back(io::vector(place + "exclusion_probability", check.sampled.exclusion_probability, "1",
                                 "sampled P(r_P > r) at the radii of pore_curve"));
}

/// "0.4566 +- 0.0014": as many decimals as the error has with two digits.
std::string with_error(double value, double error) {
    const int decimals = error > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12) : 5;
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*f +- %.*f", decimals, value, decimals, error);
    return buffer.data();
}

}  // namespace

SampledCheck compare_with_samples(const Packing& packing, const PoreSizes& exact, Index points, std::uint64_t seed) {
    SampledCheck check;
    check.sampled = characterize::sample_pores(packing, exact.radius, points, seed);
    check.largest_z = 0;
    const auto trials = static_cast<double>(check.sampled.void_points);
    for (Index k = 0; k < exact.radius.size(); ++k) {
        const double p = exact.exclusion_probability[k];
        if (trials * p * (1 - p) >= 25) {
            const double z = (check.sampled.exclusion_probability[k] - p) / std::sqrt(p * (1 - p) / trials);
            check.largest_z = std::max(check.largest_z, std::abs(z));
            ++check.radii;
        }
    }
    return check;
}

Results datasets_of(const Characterization& found, const Packing& packing) {
    Results results;
    const double r0 = mean_radius(packing);
    append_packing(results, found, packing);
    if (found.coordination) {
        append_coordination(results, *found.coordination, found.contact_tolerance);
    }
    if (found.heterogeneity) {
        append_heterogeneity(results, *found.heterogeneity, *found.pores, r0);
    }
    if (found.pores) {
        append_pore_sizes(results, *found.pores, r0);
    }
    if (found.overlaps) {
        append_overlaps(results, *found.overlaps);
    }
    if (found.check) {
        append_check(results, *found.check);
    }
    return results;
}

std::vector<io::ParticleField> fields_of(const Characterization& found) {
    if (!found.coordination) {
        return {};
    }
    return {{"coordination", found.coordination->counts.cast<double>().transpose(), "1", "number of contacts of the particle"}};
}

Table table_of(const Characterization& found, const Packing& packing) {
    Table table = {{"particles", std::to_string(packing.size())},
                   {"box", describe(packing.cell)},
                   {"volume fraction", with_unit(representative_volume_fraction(found, packing), "1") + "   (" +
                                           volume_fraction_description(found, packing) + ")"}};
    if (found.coordination) {
        table.emplace_back("coordination number", with_unit(found.coordination->mean, "1") + "   (contacts within " +
                                                      with_unit(1 + found.contact_tolerance, "1") + " diameters)");
        table.emplace_back("rattlers", with_unit(100 * found.coordination->rattler_fraction, "%") + " of the particles");
    }
    if (found.heterogeneity) {
        table.emplace_back("degree of heterogeneity a", with_error(found.heterogeneity->a, found.heterogeneity->a_stderr));
        table.emplace_back("position b", with_error(found.heterogeneity->b, found.heterogeneity->b_stderr));
        table.emplace_back("rms residual of the fit", with_unit(found.heterogeneity->rms_residual, "1"));
    }
    if (found.pores) {
        const double r0 = mean_radius(packing);
        table.emplace_back("mean pore radius", with_unit(found.pores->mean, "m") + " = " + with_unit(found.pores->mean / r0, "r0"));
        table.emplace_back("largest pore radius",
                           with_unit(found.pores->max, "m") + " = " + with_unit(found.pores->max / r0, "r0"));
    }
    if (found.overlaps) {
        table.emplace_back("overlap", with_unit(100 * found.overlaps->rms, "%") + " rms, " +
                                          with_unit(100 * found.overlaps->max, "%") + " max of the diameter, " +
                                          std::to_string(found.overlaps->pairs) + " pairs");
    }
    if (found.check) {
        table.emplace_back("sampled check", "largest |z| " + with_unit(found.check->largest_z, "1") + " over " +
                                                std::to_string(found.check->radii) + " radii, " +
                                                std::to_string(found.check->sampled.void_points) + " points");
    }
    return table;
}

}  // namespace coagula::tools
