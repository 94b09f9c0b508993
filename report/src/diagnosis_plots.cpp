#include "diagnosis_plots.hpp"

#include "plot_parts.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace coagula::report {

namespace {

using diagnose::Diagnosis;
using diagnose::Measurement;
using diagnose::PredictedRow;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

PlotAxis axis_named(const std::string& name) {
    static const std::map<std::string, std::pair<std::string, double>> known{
        {"strain", {"strain amplitude {/Symbol g}_0 [%]", 0.01}},
        {"angular_frequency", {"angular frequency ω [rad/s]", 1.0}},
        {"time", {"time t [s]", 1.0}},
        {"shear_rate", {"shear rate [1/s]", 1.0}},
        {"gap", {"gap h [mm]", 1e-3}},
        {"heterogeneity", {"degree of heterogeneity a", 1.0}},
        {"coordination", {"coordination number C", 1.0}},
        {"volume_fraction", {"volume fraction {/Symbol f}", 1.0}},
        {"pore_radius", {"distance from the nearest particle surface [µm]", 1e-6}}};
    const auto found = known.find(name);
    return found == known.end() ? PlotAxis{.label = name.empty() ? "shell of neighbours" : "row"}
                                : PlotAxis{.label = found->second.first, .unit = found->second.second};
}

/// The unit that a modulus is shown in.
PlotAxis modulus_axis(double largest) {
    static constexpr std::array units{std::pair{1e9, "GPa"}, std::pair{1e6, "MPa"}, std::pair{1e3, "kPa"}};
    for (const auto& [unit, name] : units) {
        if (largest >= unit) {
            return {.label = std::string("G', G'' [") + name + "]", .unit = unit};
        }
    }
    return {.label = "G', G'' [Pa]"};
}

double factor_of(const std::vector<diagnose::SampleEffect>& effects, const std::string& sample) {
    const auto found = std::find_if(effects.begin(), effects.end(), [&](const auto& effect) { return effect.sample == sample; });
    return found == effects.end() ? 1.0 : 1 + found->effect;
}

/// The unit that a viscosity is shown in.
PlotAxis viscosity_axis(double largest) {
    return largest < 1 ? PlotAxis{.label = "viscosity [mPa s]", .unit = 1e-3} : PlotAxis{.label = "viscosity [Pa s]"};
}

/// Observables that share a picture: an elastic and a viscous one, or one alone.
struct Pair {
    std::array<std::string, 2> observables;
    std::array<std::string, 2> symbols;
    std::string label;    ///< of the axis; empty: moduli with their unit
    std::string size;     ///< what errors of predictions are measured against
    std::string meaning;  ///< of the points
    double unit = 1;

    /// Moduli and viscosities differ by factors.
    bool scales() const { return label.empty() || observables.front() == "viscosity"; }
};

const std::array<Pair, 5> pairs{{
    {{"storage_modulus", "loss_modulus"}, {"G'", "G''"}, "", "|G*|", "Circles G', triangles G''"},
    {{"third_harmonic_storage", "third_harmonic_loss"},
     {"G_3'", "G_3''"},
     "third over first harmonic [%]",
     "|G*|",
     "Third harmonic of the stress over the first; circles: elastic part, triangles: viscous part",
     0.01},
    {{"neighbours", ""}, {"neighbours", ""}, "neighbours in a shell", "one neighbour", "Circles: neighbours in shells of distance"},
    {{"exclusion_probability", ""},
     {"pores", ""},
     "share of the void space farther away",
     "the void space",
     "Circles: share of the void space farther from any surface"},
    {{"viscosity", ""}, {"viscosity", ""}, "viscosity [Pa s]", "the viscosity", "Circles: viscosity in steady flow"},
}};

/// The rows of one table that belong to a pair, with the place of each along the axis.
struct Shown {
    const Pair& pair;
    PlotAxis x;
    std::vector<const PredictedRow*> rows = {};
    std::vector<double> places = {};  ///< in the unit of the axis
    double base_factor = 1;           ///< of the sample
    double extended_factor = 1;
};

Shown rows_of(const Measurement& table, std::size_t number, const Diagnosis& diagnosis, const Pair& pair) {
    const diagnose::Column* column = diagnose::axis_of(table);
    Shown shown{.pair = pair, .x = axis_named(column == nullptr ? "" : column->name)};
    if (pair.scales()) {
        shown.base_factor = factor_of(diagnosis.base_effects, table.sample);
        shown.extended_factor = factor_of(diagnosis.extended_effects, table.sample);
    }
    for (const PredictedRow& row : diagnosis.rows) {
        const bool belongs = std::find(pair.observables.begin(), pair.observables.end(), row.observable) != pair.observables.end();
        if (row.measurement == number && belongs) {
            const double place = column == nullptr ? static_cast<double>(row.row + 1) : column->values[row.row];
            shown.x.include(place);
            shown.rows.push_back(&row);
            shown.places.push_back(place / shown.x.unit);
        }
    }
    return shown;
}

/// Data blocks $storage_0, $storage_1 (held out), $loss_0, $loss_1: place, measured, deviation, base, extended, both residuals.
std::string blocks_of(const Shown& shown, const PlotAxis& y) {
    std::string text;
    for (const bool loss : {false, true}) {
        const std::string observable = loss ? "loss" : "storage";
        const std::string& name = shown.pair.observables.at(loss);
        for (const bool held : {false, true}) {
            text += "$" + observable + (held ? "_1" : "_0") + " << EOD\n";
            std::size_t lines = 0;
            for (std::size_t k = 0; k < shown.rows.size(); ++k) {
                const PredictedRow& row = *shown.rows[k];
                if (row.held_out == held && row.observable == name) {
                    text += line_of({shown.places[k], row.measured / y.unit, row.standard_deviation / y.unit,
                                     shown.base_factor * row.base / y.unit, shown.extended_factor * row.extended / y.unit,
                                     row.base_residual, row.extended_residual});
                    ++lines;
                }
            }
            text += (lines == 0 ? line_of(std::vector<double>(7, not_a_number)) : "") + "EOD\n";
        }
        // Both parts together, for the lines of the models.
        text += "$" + observable + " << EOD\n";
        std::size_t lines = 0;
        for (std::size_t k = 0; k < shown.rows.size(); ++k) {
            if (shown.rows[k]->observable == name) {
                text += line_of({shown.places[k], shown.base_factor * shown.rows[k]->base / y.unit,
                                 shown.extended_factor * shown.rows[k]->extended / y.unit});
                ++lines;
            }
        }
        text += (lines == 0 ? line_of(std::vector<double>(3, not_a_number)) : "") + "EOD\n";
    }
    return text;
}

bool has(const Shown& shown, const std::string& observable, bool held) {
    return std::any_of(shown.rows.begin(), shown.rows.end(),
                       [&](const PredictedRow* row) { return row->observable == observable && row->held_out == held; });
}

/// Plot of the moduli: points for what was measured, lines for the models.
std::string moduli_plot(const Shown& shown, const std::string& cause) {
    std::string plot = R"(plot $storage using 1:2 with lines linecolor rgb base linewidth 2 dashtype (9,5) title "base model")";
    if (!cause.empty()) {
        plot += R"(, $storage using 1:3 with lines linecolor rgb extended linewidth 2.4 title "with )" + cause + "\"";
        plot += R"(, $loss using 1:3 with lines linecolor rgb extended linewidth 2.4 notitle)";
    }
    plot += R"(, $loss using 1:2 with lines linecolor rgb base linewidth 2 dashtype (9,5) notitle)";
    for (const bool held : {false, true}) {
        for (const bool loss : {false, true}) {
            if (has(shown, shown.pair.observables.at(loss), held)) {
                const std::string kind = loss ? (held ? "8" : "9") : (held ? "6" : "7");
                const std::string block = std::string(", $") + (loss ? "loss" : "storage") + (held ? "_1" : "_0");
                // Bars by themselves: gnuplot leaves a white gap between a point and its bar.
                plot += block + " using 1:($2-$3):(0):(2*$3) with vectors nohead linecolor rgb ink linewidth 1 notitle" + block +
                        " using 1:2 with points linecolor rgb ink linewidth 1.1 pointsize 0.55 pointtype " + kind + " title \"" +
                        shown.pair.symbols.at(loss) + (held ? " held out" : "") + "\"";
            }
        }
    }
    return plot + "\n";
}

std::string residual_plot(const std::string& column, const std::string& colour) {
    std::string plot = "plot 0 with lines linecolor rgb ink linewidth 0.8 notitle";
    for (const std::string part : {"storage_0", "storage_1", "loss_0", "loss_1"}) {
        const bool loss = part.starts_with("loss");
        const std::string kind = loss ? (part.back() == '1' ? "8" : "9") : (part.back() == '1' ? "6" : "7");
        plot += ", $" + part + " using 1:" + column + " with points linecolor rgb " + colour + " pointsize 0.5 pointtype " + kind +
                " notitle";
    }
    return plot + "\n";
}

/// Range of residuals that shows those of one model, at least four standard deviations.
double residual_range(const Shown& shown, double PredictedRow::*residual) {
    double largest = 4;
    for (const PredictedRow* row : shown.rows) {
        largest = std::max(largest, 1.1 * std::abs(row->*residual));
    }
    return largest;
}

std::string residual_panel(const Shown& shown, double PredictedRow::*residual, const std::string& place, const std::string& title,
                           const std::string& label, const std::string& plot) {
    const std::string range = to_text(residual_range(shown, residual));
    return "set lmargin at screen 0.66; set rmargin at screen 0.985\n" + place + "\nset title \"" + title +
           "\" offset 0,-0.7\nset ylabel \"\"\nset xlabel \"" + label + "\"\nunset logscale y\nset yrange [-" + range + ":" +
           range +
           "]\nunset key\nset object 1 rectangle from graph 0, first -2 to graph 1, first 2 fillcolor rgb \"#eef1f4\" fillstyle "
           "solid "
           "noborder behind\n" +
           plot + "unset object 1\n";
}

/// The axis of a pair that is not of moduli.
PlotAxis share_axis(const Shown& shown) {
    PlotAxis y{.label = shown.pair.label, .unit = shown.pair.unit};
    y.include(0);
    for (const PredictedRow* row : shown.rows) {
        for (const double value : {row->measured - row->standard_deviation, row->measured + row->standard_deviation, row->base}) {
            y.include(value);
        }
    }
    y.high += 0.2 * (y.high - y.low);  // for the key
    return y;
}

PlotAxis moduli_axis(const Shown& shown) {
    double largest = 0;
    for (const PredictedRow* row : shown.rows) {
        largest = std::max(largest, row->measured);
    }
    PlotAxis y = shown.pair.label.empty() ? modulus_axis(largest) : viscosity_axis(largest);
    for (const PredictedRow* row : shown.rows) {
        const double low = row->measured - row->standard_deviation;
        y.include(low > 0 ? low : row->measured > 0 ? row->measured : not_a_number);
        y.include(row->measured + row->standard_deviation);
        y.include(row->base > 0 ? shown.base_factor * row->base : not_a_number);
    }
    return y;
}

}  // namespace

std::string symbol_of(const std::string& observable) {
    if (observable == "complex_modulus" || observable == "phase") {
        return observable == "phase" ? "the phase" : "|G*|";
    }
    if (observable.ends_with("_modulus")) {
        return pairs[0].symbols.at(observable == "loss_modulus");
    }
    return observable.starts_with("third_harmonic")     ? "the third harmonic"
           : observable == pairs[2].observables.front() ? "the neighbours"
           : observable == pairs[3].observables.front() ? "the pores"
           : observable == pairs[4].observables.front() ? "the viscosity"
                                                        : "all numbers";
}

namespace {

std::string draw_pair(Gnuplot& gnuplot, const Measurement& table, const Shown& shown, const std::string& cause) {
    const PlotAxis y = shown.pair.scales() ? moduli_axis(shown) : share_axis(shown);
    const bool both = !cause.empty();
    std::string commands =
        palette + blocks_of(shown, y) + "set multiplot\n" + shown.x.commands("x") + y.commands("y") +
        "set lmargin at screen 0.075; set rmargin at screen 0.585; set tmargin at screen 0.88; set bmargin at "
        "screen 0.16\nset xlabel \"" +
        shown.x.label + "\"\nset ylabel \"" + y.label +
        "\"\nset key at screen 0.33,0.985 center top horizontal Left reverse samplen 2.2 maxrows 2 textcolor rgb ink\n" +
        moduli_plot(shown, cause);
    const std::string top = both ? "set tmargin at screen 0.90; set bmargin at screen 0.61" : "";
    commands += residual_panel(shown, &PredictedRow::base_residual, top, "residuals of the base model [standard deviations]",
                               both ? "" : shown.x.label, residual_plot("6", "base"));
    if (both) {
        commands +=
            residual_panel(shown, &PredictedRow::extended_residual, "set tmargin at screen 0.465; set bmargin at screen 0.16",
                           "with " + cause + " [standard deviations]", shown.x.label, residual_plot("7", "extended"));
    }
    return gnuplot.draw(commands + "unset multiplot\n", 1080, 440, table.label + ": measured data against the models");
}

std::string draw_gain_of(Gnuplot& gnuplot, const Measurement& table, const Diagnosis& diagnosis, const Shown& shown) {
    std::map<const PredictedRow*, double> level;  // |G*| of the row, or 1
    for (const PredictedRow* one : shown.rows) {
        for (const PredictedRow* other : shown.rows) {
            level[one] = other->row == one->row ? std::hypot(level[one], other->measured) : level[one];
        }
        level[one] = shown.pair.label.empty() ? level[one] : 1.0;
    }
    std::map<bool, std::string> blocks;
    PlotAxis x{.label = shown.x.label, .unit = 1};
    for (const diagnose::HeldOutPrediction& held : diagnosis.gain.predictions) {
        const PredictedRow* row = &diagnosis.rows.at(held.row);
        const auto found = std::find(shown.rows.begin(), shown.rows.end(), row);
        if (found != shown.rows.end()) {
            const double place = shown.places[static_cast<std::size_t>(found - shown.rows.begin())];
            x.include(place);
            const auto percent = [&](double predicted) { return 100 * (predicted - row->measured) / level[row]; };
            blocks[row->observable == shown.pair.observables[1]] +=
                line_of({place, percent(held.base), percent(held.extended), percent(held.flexible)});
        }
    }
    if (blocks.empty()) {
        return {};
    }
    std::string commands = palette + x.commands("x") + "set xlabel \"" + x.label +
                           "\"\nset ylabel \"predicted less measured [% of " + shown.pair.size + "]\"\n" +
                           "set key outside top center horizontal Left reverse samplen 2.2 textcolor rgb ink\n";
    std::string plot = "plot 0 with lines linecolor rgb ink linewidth 0.8 notitle";
    for (const auto& [loss, lines] : blocks) {
        const std::string name = loss ? "$loss" : "$storage";
        commands += name + " << EOD\n" + lines + "EOD\n";
        const std::string kind = loss ? "8" : "6";
        const std::string& symbol = shown.pair.symbols.at(loss);
        plot += ", " + name + " using 1:2 with linespoints linecolor rgb base dashtype (9,5) pointtype " + kind +
                " pointsize 0.55 title \"" + symbol + " base model\", " + name +
                " using 1:4 with linespoints linecolor rgb smooth dashtype (2,3) pointtype " + kind + " pointsize 0.4 title \"" +
                symbol + " smooth correction\", " + name +
                " using 1:3 with linespoints linecolor rgb extended linewidth 1.6 pointtype " + kind + " pointsize 0.55 title \"" +
                symbol + " extended\"";
    }
    return gnuplot.draw(commands + plot + "\n", 1080, 330, table.label + ": errors of the predictions of held-out rows");
}

}  // namespace

std::vector<Picture> draw_table(Gnuplot& gnuplot, const Measurement& table, std::size_t number, const Diagnosis& diagnosis,
                                const std::string& cause) {
    std::vector<Picture> pictures;
    for (const Pair& pair : pairs) {
        const Shown shown = rows_of(table, number, diagnosis, pair);
        if (!shown.rows.empty()) {
            pictures.push_back({draw_pair(gnuplot, table, shown, cause), pair.meaning, pair.label.empty()});
        }
    }
    return pictures;
}

std::vector<Picture> draw_gain(Gnuplot& gnuplot, const Measurement& table, std::size_t number, const Diagnosis& diagnosis) {
    std::vector<Picture> pictures;
    for (const Pair& pair : pairs) {
        const std::string svg = draw_gain_of(gnuplot, table, diagnosis, rows_of(table, number, diagnosis, pair));
        if (!svg.empty()) {
            pictures.push_back({svg, pair.meaning, pair.label.empty()});
        }
    }
    return pictures;
}

}  // namespace coagula::report
