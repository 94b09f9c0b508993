// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/compare.hpp>

#include <coagula/common/readable.hpp>

#include <algorithm>
#include <cmath>

namespace coagula::characterize {

namespace {

using Inputs = std::array<const MeasureInput*, 2>;

/// The scalar of this name and its error of both structures.
ComparedMeasure compared(const std::string& name, const std::string& meaning, const std::array<MeasureResult, 2>& results,
                         const std::string& scalar) {
    ComparedMeasure measure{name, meaning};
    for (std::size_t which = 0; which < 2; ++which) {
        measure.value[which] = results[which].value(scalar);
        measure.error[which] = results[which].standard_error(scalar);
    }
    return measure;
}

void compare_pores(const std::array<MeasureResult, 2>& results, HeterogeneityComparison& comparison) {
    comparison.measures.push_back(compared("pore_sizes", "width a of the pore-size curve over r0", results, "doh/a"));
    comparison.main_part = compared("pore_sizes_main_part", "a fitted to P >= 0.1 only", results, "doh/a_main_part");
}

/// Of unequal spheres there is no smallest cell, and the volumes are divided by their mean.
void compare_voronoi(const std::array<MeasureResult, 2>& results, HeterogeneityComparison& comparison) {
    ComparedMeasure width =
        compared("voronoi_volumes", "standard deviation of the free Voronoi volume over its mean", results, "voronoi/width");
    if (!std::isfinite(width.difference())) {
        width = compared("voronoi_volumes", "standard deviation of the Voronoi (power) cell volumes over their mean", results,
                         "voronoi/deviation");
    }
    comparison.measures.push_back(width);
}

DensityFluctuations fluctuations_over_r0(const MeasureInput& input, double largest) {
    DensityFluctuations found = measure_density_fluctuations(input.packing(), input.inner(), largest);
    found.edge /= input.r0();
    return found;
}

/// The integrals over the windows that both structures have.
void compare_fluctuations(const Inputs& inputs, HeterogeneityComparison& comparison) {
    constexpr double fewest = 4;  // r0: windows of 2 to 4 are the least that an integral is taken over
    std::array<DensityFluctuations, 2> found;
    try {
        double largest = largest_window;
        for (std::size_t which = 0; which < 2; ++which) {
            found[which] = fluctuations_over_r0(*inputs[which], largest_window);
            largest = std::min(largest, found[which].edge[found[which].edge.size() - 1]);
        }
        require(largest >= fewest, "no windows of up to four mean radii fit into both structures");
        if (largest < largest_window) {
            for (std::size_t which = 0; which < 2; ++which) {
                found[which] = fluctuations_over_r0(*inputs[which], largest);
            }
        }
        comparison.measures.push_back({"density_fluctuations",
                                       "integral of the density fluctuations over windows of 2 to " + with_unit(largest, "r0"),
                                       {found[0].integral, found[1].integral},
                                       {found[0].integral_error, found[1].integral_error}});
        comparison.fluctuations = compare_density_fluctuations(found[0], found[1]);
    } catch (const std::invalid_argument& reason) {
        comparison.left_out.push_back(std::string("density fluctuations: ") + reason.what());
    }
}

MeasureResult measured(const MeasureInput& input, const std::string& name) {
    const std::vector<std::string> needed = {"doh", "voronoi"};
    try {
        MeasureResult found = run_measures(input, needed);
        for (const std::string& measure : needed) {
            const std::string reason = found.reason_left_out(measure);
            if (!reason.empty()) {
                throw std::runtime_error(name + ": " + measure + ": " + reason);
            }
        }
        return found;
    } catch (const std::invalid_argument& reason) {
        throw std::invalid_argument(name + ": " + reason.what());
    }
}

double radius_spread(const Packing& packing) {
    const double mean = mean_radius(packing);
    return std::sqrt((packing.radii.array() - mean).square().mean()) / mean;
}

double measured_volume_fraction(const MeasureInput& input) {
    return input.packing().cell.is_periodic() ? volume_fraction(input.packing()) : 1 - input.pores().void_fraction;
}

std::vector<std::string> reasons_against(const Inputs& inputs) {
    constexpr double fraction_limit = 0.01;
    constexpr double spread_limit = 0.01;
    constexpr double count_limit = 2;
    std::vector<std::string> reasons;
    const auto both = [&](const auto& of) { return std::array{of(*inputs[0]), of(*inputs[1])}; };
    const auto fraction = both(measured_volume_fraction);
    if (std::abs(fraction[1] - fraction[0]) > fraction_limit * std::max(fraction[0], fraction[1])) {
        reasons.push_back("the volume fractions are " + with_unit(fraction[0], "1") + " and " + with_unit(fraction[1], "1") +
                          ", and a denser structure is more homogeneous by each measure");
    }
    const auto spread = both([](const MeasureInput& input) { return radius_spread(input.packing()); });
    if (std::abs(spread[1] - spread[0]) > spread_limit) {
        reasons.push_back("the radii have standard deviations of " + with_unit(100 * spread[0], "%") + " and " +
                          with_unit(100 * spread[1], "%") + " of their mean, which changes each measure");
    }
    const auto count = both([](const MeasureInput& input) { return static_cast<double>(std::ranges::count(input.inner(), true)); });
    if (std::max(count[0], count[1]) > count_limit * std::min(count[0], count[1])) {
        reasons.push_back("the structures have " + with_unit(count[0], "1") + " and " + with_unit(count[1], "1") +
                          " particles that count, and a small one lacks the large pores and the long waves of density");
    }
    if (inputs[0]->packing().cell.is_periodic() != inputs[1]->packing().cell.is_periodic()) {
        reasons.emplace_back("one structure has a free surface, the other is periodic");
    }
    return reasons;
}

}  // namespace

double ComparedMeasure::difference_error() const {
    return std::hypot(error[0], error[1]);
}

std::optional<std::size_t> ComparedMeasure::more_heterogeneous() const {
    if (!(std::abs(difference()) > 2 * difference_error())) {
        return std::nullopt;
    }
    return difference() > 0 ? 1 : 0;
}

Agreement HeterogeneityComparison::agreement() const {
    std::array<std::size_t, 2> votes{};
    for (const ComparedMeasure& measure : measures) {
        if (const auto which = measure.more_heterogeneous()) {
            ++votes.at(*which);
        }
    }
    const std::size_t most = std::max(votes[0], votes[1]);
    if (std::min(votes[0], votes[1]) > 0) {
        return Agreement::disagree;
    }
    return most == 0 ? Agreement::none : (most == measures.size() ? Agreement::all : Agreement::some);
}

std::optional<std::size_t> HeterogeneityComparison::more_heterogeneous() const {
    if (agreement() == Agreement::disagree) {
        return std::nullopt;
    }
    for (const ComparedMeasure& measure : measures) {
        if (const auto which = measure.more_heterogeneous()) {
            return which;
        }
    }
    return std::nullopt;
}

HeterogeneityComparison compare_heterogeneity(const MeasureInput& first, const MeasureInput& second,
                                              const std::array<std::string, 2>& names) {
    HeterogeneityComparison comparison;
    const Inputs inputs = {&first, &second};
    const std::array<MeasureResult, 2> results = {measured(first, names[0]), measured(second, names[1])};
    compare_pores(results, comparison);
    compare_voronoi(results, comparison);
    compare_fluctuations(inputs, comparison);
    comparison.unfair = reasons_against(inputs);
    return comparison;
}

}  // namespace coagula::characterize
