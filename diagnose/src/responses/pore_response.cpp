// SPDX-License-Identifier: GPL-3.0-or-later
#include "pore_response.hpp"

#include "imaged_pores.hpp"
#include "interpolation.hpp"
#include "pore_scatter.hpp"
#include "structure_changes.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/dense.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::diagnose {

namespace {

constexpr Index least_particles_of_pores = 1000;   ///< so that what is drawn scatters less than the structures
constexpr NodeAxis pore_error_axis{0.02, 0.9, 5};  ///< standard deviation over the diameter
constexpr LinearAxis share_axis{0, 0.1, 5};
constexpr int radii = 201;
constexpr double largest_pore = 4;  ///< in particle radii, where a curve ends; it is compared down to 0.01

const PoreCurve& pore_curve(Simulator& simulator, std::size_t structure) {
    return simulator.remembered({"pores", structure}, [&]() -> PoreCurve {
        const std::vector<double>& values = simulator.simulated({"pores", structure}, 0, [&](const Packing& packing) {
            simulator.progress().update("simulating", 0.0, "pores");
            const PoreCurve measured = simulator.measured_pores(packing);
            std::vector<double> numbers{measured.largest};
            numbers.insert(numbers.end(), measured.probability.begin(), measured.probability.end());
            return numbers;
        });
        return {values.front(), {values.begin() + 1, values.end()}};
    });
}

double mean_exclusion_probability(Simulator& simulator, double pore_radius) {
    double sum = 0;
    for (std::size_t k = 0; k < simulator.structures(); ++k) {
        sum += pore_curve(simulator, k).at(pore_radius);
    }
    return sum / static_cast<double>(simulator.structures());
}

/// Mean over the structures, for errors in the plane and along z over the diameter and the shares of missed and of false centres.
const PoreCurve& imaged_pores(Simulator& simulator, const std::array<double, 4>& errors) {
    const std::vector<double> at(errors.begin(), errors.end());
    return simulator.remembered({"imaged pores", 0, at}, [&]() -> PoreCurve {
        const double largest = largest_pore * simulator.radius();
        const double diameter = 2 * simulator.radius();
        const ImageErrors image{diameter * errors[0], diameter * errors[1], errors[2], errors[3]};
        return {largest, simulator.mean_over_structures("imaged pores", radii, at, [&](const Packing& structure) {
                    simulator.progress().update("simulating", 0.0, "pores in images");
                    const Index draws = 1 + least_particles_of_pores / structure.size();
                    std::vector<double> mean(radii, 0.0);
                    for (Index draw = 0; draw < draws; ++draw) {
                        const PoreCurve one =
                            simulator.measured_pores(as_imaged(structure, image, static_cast<std::uint64_t>(draw)));
                        for (std::size_t k = 0; k < mean.size(); ++k) {
                            mean[k] += one.at(largest * static_cast<double>(k) / (radii - 1)) / static_cast<double>(draws);
                        }
                    }
                    return mean;
                })};
    });
}

/// What the errors change in the mean of the structures, `probability`. Those of the places, missed and false centres add up,
/// unless they are to act together.
double change_in_images(Simulator& simulator, const Settings& settings, double pore_radius, double probability, bool exact) {
    const double plane = settings.localisation_plane / (2 * simulator.radius());
    const double axis = settings.localisation_axis / (2 * simulator.radius());
    const double missed = settings.missed_share;
    const double wrong = settings.false_share;
    const auto changed_by = [&](const std::array<double, 4>& errors) {
        return imaged_pores(simulator, errors).at(pore_radius) - probability;
    };
    if (plane == 0 && axis == 0 && missed == 0 && wrong == 0) {
        return 0;
    }
    if (exact) {
        return changed_by({plane, axis, missed, wrong});
    }
    double change = 0;
    if (plane > 0 || axis > 0) {
        change += interpolate_nodes(pore_error_axis, plane, axis, [&](int i, int j) {
            return changed_by({pore_error_axis.node(i), pore_error_axis.node(j), 0, 0});
        });
    }
    const auto at_share = [&](double share, const auto& errors) {
        return share == 0 ? 0.0 : interpolate_nodes(share_axis, share, [&](int k) {
            return k == 0 ? 0.0 : changed_by(errors(share_axis.node(k)));
        });
    };
    change += at_share(missed, [](double share) { return std::array<double, 4>{0, 0, share, 0}; });
    change += at_share(wrong, [](double share) { return std::array<double, 4>{0, 0, 0, share}; });
    return change;
}

/// Mean over the structures.
Eigen::MatrixXd mean_covariance(Simulator& simulator) {
    return simulator.remembered({"scatter of pores"}, [&]() -> Eigen::MatrixXd {
        const std::vector<double> mean =
            simulator.mean_over_structures("scatter of pores", scatter_radii * scatter_radii, {}, covariance_of_pores);
        return Eigen::Map<const Eigen::MatrixXd>(mean.data(), scatter_radii, scatter_radii);
    });
}

}  // namespace

double exclusion_probability(Simulator& simulator, const Settings& settings, double pore_radius, bool exact) {
    const double changed = over_changes(simulator, settings.structures,
                                        [&](Simulator& other) { return mean_exclusion_probability(other, pore_radius); });
    const double images =
        change_in_images(simulator, settings, pore_radius, mean_exclusion_probability(simulator, pore_radius), exact);
    return std::clamp(changed + images, 0.0, 1.0);
}

Eigen::MatrixXd pore_errors(Simulator& simulator, const StructureChange& change, const std::vector<double>& pore_radii) {
    require(simulator.structures() > 0, "the errors of a pore curve need structures");
    constexpr Index axes = 6;  // the seventh has less than a thousandth of the variance
    const Eigen::MatrixXd covariance = over_changes(simulator, change, mean_covariance);
    const dense::SymmetricModes modes(covariance);
    const Eigen::VectorXd deviations = modes.values.tail(axes).cwiseMax(0).cwiseSqrt();
    const Eigen::MatrixXd at_nodes = modes.vectors.rightCols(axes) * deviations.asDiagonal();
    Eigen::MatrixXd errors(static_cast<Index>(pore_radii.size()), axes);
    for (Index row = 0; row < errors.rows(); ++row) {
        const double radius = pore_radii[static_cast<std::size_t>(row)];
        const double place = std::clamp(radius / simulator.radius() / scatter_step, 0.0, scatter_radii - 1.0);
        const Index below = std::min(static_cast<Index>(place), scatter_radii - 2);
        const double beyond = place - static_cast<double>(below);
        errors.row(row) = (1 - beyond) * at_nodes.row(below) + beyond * at_nodes.row(below + 1);
    }
    return errors;
}

}  // namespace coagula::diagnose
