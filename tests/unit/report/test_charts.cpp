#include "chart_axis.hpp"
#include "chart_legend.hpp"

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

TEST(Charts, LeaveOutWhatAnAxisCannotShow) {
    Chart chart = chart_of({.x = {1, 2, 3, 4}, .y = {1, unset, 0, -1}});
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0, 2, 3}));
    chart.y.logarithmic = true;
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0}));
    chart.series[0].second_axis = true;  // which is linear
    EXPECT_EQ(shown_places(chart, chart.series[0]), (std::vector<std::size_t>{0, 2, 3}));
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
    EXPECT_EQ(shown("rad-1", 3).unit, "1/rad");
    EXPECT_DOUBLE_EQ(shown("rad-1", 3).scale, 1);
}

TEST(Charts, LengthsTakeTheirPrefix) {
    const SettledAxis axis = settle({.unit = "m"}, {2e-8, 3e-7});
    EXPECT_EQ(axis.unit, "nm");
    EXPECT_DOUBLE_EQ(axis.scale, 1e-9);
    EXPECT_LT(axis.low, 20);
    EXPECT_GT(axis.high, 300);
}

TEST(Charts, LogarithmicAxesHaveTicksHoweverNarrow) {
    for (const auto& [low, high] : {std::pair(1.2, 1.4), std::pair(1.2, 30.0)}) {
        const std::string commands = axis_commands(settle({.logarithmic = true}, {low, high}), "x");
        const std::size_t begin = commands.find("tics (");
        ASSERT_NE(begin, std::string::npos);
        EXPECT_GE(std::count(commands.begin() + static_cast<std::ptrdiff_t>(begin), commands.end(), ','), 2) << commands;
    }
    EXPECT_TRUE(contains(axis_commands(settle({.logarithmic = true}, {1, 1e4}), "x"), "10^{%T}"));
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
