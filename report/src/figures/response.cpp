// SPDX-License-Identifier: GPL-3.0-or-later
// Answers to oscillation and to a ramp: moduli over frequency or amplitude, stress over strain or time.
#include "figure_parts.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::report {

namespace {

const std::string frequency_group = "/mechanics/frequency/";
const std::string quasistatic_group = "/mechanics/quasistatic/";
const std::string compression_group = "/mechanics/compression/";
const std::string dem_group = "/mechanics/dem/";

ChartAxis logarithmic_moduli() {
    return {.name = "moduli {/:Italic G}′, {/:Italic G}″", .plain = "modulus", .unit = "Pa", .logarithmic = true};
}

std::string symbol_with(const std::string& name, const std::string& symbol) {
    return name.empty() ? symbol : name + ", " + symbol;
}

/// G' filled and G'' open, with the spread over the orientations; a G'' of zero is not there.
/// Moduli along an axis; a spread may be empty.
struct Moduli {
    std::vector<double> x;
    std::vector<double> storage;
    std::vector<double> storage_spread;
    std::vector<double> loss;
    std::vector<double> loss_spread;
};

Moduli moduli_over(const FigureSource& source, const std::string& axis, const std::string& group) {
    return {source.numbers(axis), source.numbers(group + "storage_modulus/mean"), source.numbers(group + "storage_modulus/std"),
            source.numbers(group + "loss_modulus/mean"), source.numbers(group + "loss_modulus/std")};
}

void add_moduli(Chart& chart, const std::string& name, int colour, const Moduli& moduli) {
    chart.series.push_back({.name = symbol_with(name, "G'"),
                            .x = moduli.x,
                            .y = moduli.storage,
                            .error = moduli.storage_spread,
                            .mark = Mark::line_points,
                            .colour = colour});
    if (std::any_of(moduli.loss.begin(), moduli.loss.end(), [](double value) { return value > 0; })) {
        chart.series.push_back({.name = symbol_with(name, "G''"),
                                .x = moduli.x,
                                .y = moduli.loss,
                                .error = moduli.loss_spread,
                                .mark = Mark::open_line_points,
                                .colour = colour});
    }
}

/// Mean over the rows of a [runs][entries] array.
std::vector<double> mean_of_runs(const FigureSource& source, const std::string& path) {
    const std::vector<double> all = source.numbers(path);
    const std::vector<std::size_t>& shape = source.find(path)->shape;
    if (shape.size() != 2) {
        throw InputError(source.file + ": " + path + " should have one row per orientation");
    }
    std::vector<double> mean(shape[1], 0);
    for (std::size_t k = 0; k < all.size(); ++k) {
        mean[k % shape[1]] += all[k] / static_cast<double>(shape[0]);
    }
    return mean;
}

std::vector<double> first_run(const FigureSource& source, const std::string& path) {
    const std::vector<double> all = source.numbers(path);
    const std::vector<std::size_t>& shape = source.find(path)->shape;
    const std::size_t count = shape.size() == 2 ? shape[1] : all.size();
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()))};
}

void add_amplitudes(Chart& chart, const FigureSource& source, const std::string& name, int colour) {
    const std::string& group = quasistatic_group;
    if (source.find(group + "amplitude") == nullptr && source.find(dem_group + "oscillations/amplitude") != nullptr) {
        const std::string dem = dem_group + "oscillations/";
        add_moduli(chart, name, colour,
                   {mean_of_runs(source, dem + "amplitude"),
                    mean_of_runs(source, dem + "storage_modulus"),
                    {},
                    mean_of_runs(source, dem + "loss_modulus"),
                    {}});
        return;
    }
    add_moduli(chart, name, colour, moduli_over(source, group + "amplitude", group));
}

/// Orientations of the ramps of a file, such as "zx". @param usual is returned, so that its absence is told, where there are none.
std::vector<std::string> ramps_of(const FigureSource& source, const std::string& group, const std::string& usual) {
    const std::string begin = group + "ramp/";
    const std::string end = "/stress";
    std::vector<std::string> orientations;
    for (const io::Dataset& dataset : source.structure().results) {
        if (dataset.path.starts_with(begin) && dataset.path.ends_with(end)) {
            orientations.push_back(dataset.path.substr(begin.size(), dataset.path.size() - begin.size() - end.size()));
        }
    }
    if (orientations.empty()) {
        orientations.push_back(usual);
    }
    return orientations;
}

/// Stress of each ramp over another of its data sets.
void add_ramps(Chart& chart, const Sources& sources, const std::string& group, const std::string& usual, const std::string& over) {
    int colour = 0;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        for (const std::string& orientation : ramps_of(sources[k], group, usual)) {
            const std::string path = group + "ramp/" + orientation + "/";
            const std::string name = legend_name(sources, k);
            Series series{.name = name.empty() ? orientation : name + ", " + orientation, .colour = colour++};
            series.x = sources[k].numbers(path + over);
            series.y = sources[k].numbers(path + "stress");
            chart.series.push_back(std::move(series));
        }
    }
}

}  // namespace

Drawing draw_frequency_response(const Sources& sources) {
    Chart chart{.x = {.name = "frequency {/:Italic f}", .plain = "frequency", .unit = "Hz", .logarithmic = true},
                .y = logarithmic_moduli(),
                .legend = Legend::bottom_right};
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const FigureSource& source = sources[k];
        add_moduli(chart, legend_name(sources, k), static_cast<int>(k),
                   moduli_over(source, frequency_group + "frequency", frequency_group));
    }
    return {.panels = {chart},
            .caption =
                "Storage modulus G' (filled) and loss modulus G'' (open) against frequency; mean of six orientations. The bars are "
                "the standard deviation over the orientations."};
}

Drawing draw_amplitude_response(const Sources& sources) {
    Chart chart{.x = {.name = "strain amplitude {/Symbol g}_0", .plain = "strain amplitude", .logarithmic = true},
                .y = logarithmic_moduli(),
                .legend = Legend::bottom_left};
    for (std::size_t k = 0; k < sources.size(); ++k) {
        add_amplitudes(chart, sources[k], legend_name(sources, k), static_cast<int>(k));
    }
    return {.panels = {chart},
            .caption =
                "Storage modulus G' (filled) and loss modulus G'' (open) against the amplitude of the strain; mean of the "
                "orientations. The bars are the standard deviation over the orientations."};
}

Drawing draw_stress_strain(const Sources& sources) {
    Chart chart{.x = {.name = "shear strain {/Symbol g}", .plain = "shear strain"},
                .y = {.name = "shear stress {/Symbol s}", .plain = "shear stress", .unit = "Pa"},
                .legend = Legend::bottom_right};
    add_ramps(chart, sources, quasistatic_group, "zx", "strain");
    return {.panels = {chart}, .caption = "Shear stress against shear strain in quasi-static equilibria."};
}

Drawing draw_compression(const Sources& sources) {
    Chart chart{.x = {.name = "volume fraction {/Symbol f}", .plain = "volume fraction"},
                .y = {.name = "normal stress {/Symbol s}", .plain = "normal stress", .unit = "Pa"},
                .legend = Legend::top_left};
    add_ramps(chart, sources, compression_group, "zz", "volume_fraction");
    return {.panels = {chart},
            .caption =
                "Normal stress along the axis of a uniaxial compression against the volume fraction, in quasi-static equilibria."};
}

Drawing draw_oscillations(const Sources& sources) {
    constexpr double shown_per_oscillation = 20;
    const FigureSource& source = sources.front();
    const std::vector<double> strain = first_run(source, dem_group + "samples/strain");
    const std::vector<double> stress = first_run(source, dem_group + "samples/stress");
    const auto oscillations = static_cast<double>(first_run(source, dem_group + "oscillations/amplitude").size());
    const double samples = static_cast<double>(stress.size()) / oscillations;  // of one oscillation
    const auto step = static_cast<std::size_t>(std::max(1.0, std::round(samples / shown_per_oscillation)));
    Series shown_stress{.name = "stress (left)", .mark = Mark::open_points, .colour = 1};
    Series shown_strain{.name = "strain (right)", .mark = Mark::line, .colour = 0, .second_axis = true};
    for (std::size_t k = 0; k < std::min(strain.size(), stress.size()); ++k) {
        const double cycle = static_cast<double>(k + 1) / samples;
        shown_strain.x.push_back(cycle);
        shown_strain.y.push_back(strain[k]);
        if ((k + 1) % step == 0) {
            shown_stress.x.push_back(cycle);
            shown_stress.y.push_back(stress[k]);
        }
    }
    const Chart chart{.x = {.name = "oscillation cycle", .plain = "oscillation cycle", .low = 0},
                      .y = {.name = "shear stress {/Symbol s}", .plain = "shear stress", .unit = "Pa"},
                      .second_y = {.name = "shear strain {/Symbol g}", .plain = "shear strain"},
                      .series = {shown_strain, shown_stress},
                      .legend = Legend::top_left};
    return {.panels = {chart},
            .caption =
                "Shear stress (open squares, left scale) and shear strain (line, right scale) against the oscillation "
                "cycle; explicit discrete elements, first orientation of " +
                source.label + "."};
}

}  // namespace coagula::report
