// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_axis.hpp"
#include "chart_legend.hpp"

#include <coagula/io/printable.hpp>
#include <coagula/report/chart.hpp>

#include <gtest/gtest.h>

#include <algorithm>

using namespace coagula;
using namespace coagula::report;

namespace {

Chart chart_of(Series series) {
    return {.x = {.name = "x", .plain = "x"}, .y = {.name = "y", .plain = "y"}, .series = {std::move(series)}};
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// What stands at the ticks of a logarithmic axis.
std::vector<std::string> numbers_at_ticks(const std::string& commands) {
    const std::size_t begin = commands.find("tics (");
    const std::string ticks = commands.substr(begin, commands.find("\nset", begin) - begin);
    std::vector<std::string> numbers;
    for (std::size_t open = 0; (open = ticks.find('"', open)) != std::string::npos;) {
        const std::size_t close = ticks.find('"', open + 1);
        if (close > open + 1) {
            numbers.push_back(ticks.substr(open + 1, close - open - 1));
        }
        open = close + 1;
    }
    return numbers;
}

TEST(Charts, LeaveOutWhatAnAxisCannotShow) {
    Chart chart = chart_of({.x = {1, 2, 3, 4}, .y = {1, unset, 0, -1}});
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0, 2, 3}));
    chart.y.logarithmic = true;
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0}));
    EXPECT_EQ(values_below_axis({.panels = {chart}, .caption = ""}), 1U);
    chart.series[0].second_axis = true;  // which is linear
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(values_below_axis({.panels = {chart}, .caption = ""}), 0U);
}

TEST(Charts, GiveDataInTheUnitOfTheFileAndAxesInOneThatSuits) {
    Chart chart = chart_of({.name = "s", .x = {0.1, 0.2}, .y = {1.5e6, 2e6}, .error = {1e5, unset}, .mark = Mark::points});
    chart.y.unit = "Pa";
    const auto rows = chart_rows({.panels = {chart}, .caption = ""});
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1], (std::vector<std::string>{"s", "x", "0.1", "y [Pa]", "1500000", "1e+05"}));
    EXPECT_EQ(rows[2].back(), "");
    const std::string commands = gnuplot_commands({.panels = {chart}, .caption = ""});
    EXPECT_TRUE(contains(commands, "(MPa)"));
    EXPECT_TRUE(contains(commands, "0.1 1.5 1.4 "));  // the bar from 1.4 MPa
    EXPECT_TRUE(contains(commands, "0.2 2 2 0"));
}

TEST(Charts, AxesShowInverseLengthsOverALengthWithPrefix) {
    const auto shown = [](const std::string& unit, double largest) { return settle({.unit = unit}, {0, largest}); };
    EXPECT_EQ(shown("m-1", 2e7).unit, "1/µm");
    EXPECT_DOUBLE_EQ(shown("m-1", 2e7).scale, 1e6);
    EXPECT_EQ(shown("m-3", 1e19).unit, "1/µm3");
    EXPECT_DOUBLE_EQ(shown("m-3", 1e19).scale, 1e18);
    EXPECT_EQ(shown("m-2", 0.5).unit, "1/km2");
    EXPECT_EQ(shown("rad-1", 3).unit, "1/°");
    EXPECT_DOUBLE_EQ(shown("rad", 3).scale * shown("rad-1", 3).scale, 1);
    EXPECT_NEAR(shown("rad", 3.14159265).high, 180 * 1.06, 1e-6);
}

TEST(Charts, LengthsTakeTheirPrefix) {
    const SettledAxis axis = settle({.unit = "m"}, {2e-8, 3e-7});
    EXPECT_EQ(axis.unit, "nm");
    EXPECT_DOUBLE_EQ(axis.scale, 1e-9);
    EXPECT_LT(axis.low, 20);
    EXPECT_GT(axis.high, 300);
}

TEST(Charts, LogarithmicAxesHaveTicksHoweverNarrow) {
    for (const auto& [low, high] : {std::pair(1.2, 1.4), std::pair(1.2, 30.0), std::pair(1e-6, 4e7)}) {
        const std::vector<std::string> numbers = numbers_at_ticks(axis_commands(settle({.logarithmic = true}, {low, high}), "x"));
        EXPECT_GE(numbers.size(), 3U) << low;
        EXPECT_LE(numbers.size(), 10U) << low;
    }
}

TEST(Charts, LogarithmicAxesOfOneFigureWriteTheirNumbersAlike) {
    Chart chart = chart_of({.name = "a", .x = {0.1, 1e5}, .y = {600, 9000}, .mark = Mark::line});
    chart.x.logarithmic = chart.y.logarithmic = true;
    const std::string commands = gnuplot_commands({.panels = {chart}, .caption = ""});
    EXPECT_TRUE(contains(commands, "\"10^{4}\" 10000"));
    EXPECT_TRUE(contains(commands, "\"2⋅10^{3}\" 2000"));
    chart.series[0].x = {2, 50};  // two short axes are easier to read without powers
    const std::string plain = gnuplot_commands({.panels = {chart}, .caption = ""});
    EXPECT_TRUE(contains(plain, "\"2000\" 2000") && contains(plain, "\"20\" 20"));
    EXPECT_FALSE(contains(plain, "10^"));
}

TEST(Charts, AnAxisIsNeverNarrowerThanAMillionth) {
    for (const double value : {0.37, -5e6, 3e-9}) {
        const SettledAxis axis = settle({}, {value, value * (1 + 1e-15)});
        EXPECT_GE(axis.high - axis.low, 0.99e-6 * std::abs(value)) << value;
        EXPECT_LE(axis.high - axis.low, 0.3 * std::abs(value)) << value;
    }
    const SettledAxis narrow = settle({}, {0.4, 0.4 * (1 + 3e-6)});
    EXPECT_TRUE(contains(axis_commands(narrow, "x"), "'%.7h'")) << axis_commands(narrow, "x");  // neighbouring ticks differ
}

TEST(Charts, EndsThatAreAskedForAreKept) {
    const SettledAxis axis = settle({.unit = "m", .low = 0, .high = 2e-6}, {5e-7, 9e-7});
    EXPECT_EQ(axis.unit, "µm");
    EXPECT_DOUBLE_EQ(axis.low, 0);
    EXPECT_DOUBLE_EQ(axis.high, 2);
    const SettledAxis half = settle({.low = 0.2}, {0.5, 1});
    EXPECT_DOUBLE_EQ(half.low, 0.2);
    EXPECT_GT(half.high, 1);
    EXPECT_THROW(settle({.low = 3}, {0.5, 1}), InputError);
    EXPECT_THROW(settle({.low = 1, .high = 1 + 1e-9}, {0.5, 1}), InputError);
    EXPECT_THROW(settle({.logarithmic = true, .low = 0}, {0.5, 1}), InputError);
}

TEST(Charts, NamesFitTheFrameOfTheirLegend) {
    const Frame frame = frame_of({}, 1);
    EXPECT_EQ(fitted_name("gamma law", frame), "gamma law");
    for (const std::string& name : {std::string(200, 'W'), std::string(90, 'i') + std::string(90, 'm'),
                                    std::string("vem-") + std::string(99, '0') + "-seed-7"}) {
        const std::string fitted = fitted_name(name, frame);
        EXPECT_TRUE(contains(fitted, "…"));
        EXPECT_EQ(fitted.front(), name.front());
        EXPECT_EQ(fitted.back(), name.back());
        EXPECT_LT(fitted.size(), name.size());
    }
    std::string umlauts;
    for (int k = 0; k < 99; ++k) {
        umlauts += "ü";
    }
    EXPECT_TRUE(io::is_utf8(fitted_name(umlauts, frame)));
    // Wide letters take more room than gnuplot thinks, narrow ones less.
    Chart chart = chart_of({.name = "WWWWWWWW", .x = {0, 1}, .y = {1, 0}, .mark = Mark::line});
    ChartAxes axes{settle(chart.x, {0, 1}), settle(chart.y, {0, 1}), {}};
    EXPECT_FALSE(contains(place_legend(chart, axes), "width -"));
    chart.series[0].name = "illllill";
    EXPECT_TRUE(contains(place_legend(chart, axes), "width -"));
}

TEST(Charts, AKindOfLineThatAllFilesHaveHasANeutralKey) {
    Chart chart = chart_of({.name = "file", .x = {0, 1}, .y = {1, 0}, .mark = Mark::line, .colour = 0});
    chart.series.push_back({.name = "fit", .mark = Mark::dashed_line, .colour = -1, .key_only = true});
    const std::string commands = gnuplot_commands({.panels = {chart}, .caption = ""});
    EXPECT_TRUE(contains(commands, "NaN with lines linewidth 1.2 dashtype (16,10) linecolor rgb '#000000' title (\"fit\")"));
    EXPECT_EQ(chart_rows({.panels = {chart}, .caption = ""}).size(), 3U);
}

TEST(Charts, AFontIsNoCommand) {
    const Chart chart = chart_of({.name = "a", .x = {1, 2}, .y = {1, 2}});
    for (const std::string font : {"Arial' ; system", "", "a,12", "x\ny"}) {
        EXPECT_THROW(draw({.panels = {chart}, .caption = ""}, PictureFormat::svg, {.font = font}), InputError) << font;
    }
}

TEST(Charts, TextsAreQuotedForGnuplot) {
    EXPECT_EQ(quoted_text("a\"b\\c"), R"("a\"b\\c")");
    EXPECT_EQ(quoted_text("`1"), R"("\140" . "1")");
    EXPECT_EQ(quoted_text("@1"), R"("\100" . "1")");
    EXPECT_EQ(quoted_text("a\nb\x1b"), R"("a b ")");
}

TEST(Charts, TheLegendStandsWhereNoDataAre) {
    Chart chart = chart_of({.name = "a", .x = {0, 1}, .y = {1, 0}, .mark = Mark::line});  // falls: top right is free
    ChartAxes axes{settle(chart.x, {0, 1}), settle(chart.y, {0, 1}), {}};
    EXPECT_TRUE(contains(place_legend(chart, axes), "top right"));
    chart.series[0].y = {0, 1};
    EXPECT_TRUE(contains(place_legend(chart, axes), "top left"));
    chart.series[0] = {.name = "a", .x = {0, 1, 1, 0}, .y = {0, 0, 1, 1}, .mark = Mark::points};  // data in every corner
    const double high = axes.y.high;
    EXPECT_TRUE(contains(place_legend(chart, axes), "top"));
    EXPECT_GT(axes.y.high, 1.05 * high);
}

TEST(Charts, RefuseToDrawNothing) {
    const Chart chart = chart_of({.name = "a", .x = {1}, .y = {unset}});
    EXPECT_THROW(draw({.panels = {chart}, .caption = ""}, PictureFormat::svg, {}), InputError);
}

TEST(Charts, TheEndingNamesTheFormat) {
    EXPECT_EQ(picture_format("a.b.pdf", "--output"), PictureFormat::pdf);
    EXPECT_THROW(picture_format("a.jpg", "--output"), InputError);
}

}  // namespace
