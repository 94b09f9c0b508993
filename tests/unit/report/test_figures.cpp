// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/published_structures.hpp"

#include <coagula/report/figures.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace coagula;
using namespace coagula::report;

namespace {

FigureSource source_of(std::vector<io::Dataset> results, const std::string& label, const std::string& stage = "import") {
    FigureSource source{.file = label + ".h5", .label = label};
    source.contents.emplace();
    source.contents->results = std::move(results);
    source.contents->history.emplace_back();
    source.contents->history.back().stage = stage;
    Packing& packing = source.contents->structure.packing;
    packing.positions = Eigen::Vector3d(0.5, 0.5, 0.5);
    packing.radii = Eigen::VectorXd::Constant(1, 0.1);
    packing.cell = Cell::periodic(Eigen::Vector3d::Ones());
    return source;
}

std::vector<io::Dataset> moduli(double a, double modulus) {
    return {io::scalar("/characterization/doh/a", a, "1", "a"),
            io::scalar("/mechanics/linear/storage_modulus/mean", modulus, "Pa", "G'"),
            io::scalar("/mechanics/linear/storage_modulus/std", 0.1 * modulus, "Pa", "over the orientations")};
}

TEST(Figures, AreNamedOnceAndSayWhatTheyShow) {
    std::set<std::string> names;
    for (const Figure& figure : figures()) {
        EXPECT_TRUE(names.insert(figure.name).second) << figure.name;
        EXPECT_FALSE(figure.meaning.empty()) << figure.name;
        EXPECT_EQ(&figure_named(figure.name), &figure);
    }
    EXPECT_THROW(figure_named("no-such-figure"), InputError);
}

TEST(Figures, OfFilesWithoutResultsNameTheCommandThatComputesThem) {
    const std::set<std::string> of_structure_alone = {"packing", "rheometer"};
    for (const Figure& figure : figures()) {
        if (of_structure_alone.contains(figure.name) || figure.input == FigureInput::tables) {
            continue;
        }
        try {
            figure.draw({source_of({}, "empty")});
            ADD_FAILURE() << figure.name;
        } catch (const InputError& error) {
            const std::string sentence = error.what();
            EXPECT_TRUE(sentence.find("'coagula characterize empty.h5") != std::string::npos ||
                        sentence.find("'coagula shear empty.h5") != std::string::npos)
                << sentence;
        }
    }
}

TEST(Figures, CountsBecomeShares) {
    Eigen::VectorXi counts(4);
    counts << 1, 2, 1, 0;
    const Drawing drawing =
        draw_figure(figure_named("contacts"),
                    {source_of({io::integers("/characterization/coordination_histogram", counts, "counts")}, "a")}, false);
    const Series& series = drawing.panels.at(0).series.at(0);
    EXPECT_EQ(series.y, (std::vector<double>{0.25, 0.5, 0.25}));  // the empty end is left out
    EXPECT_EQ(series.name, "");                                   // one file needs no legend
}

TEST(Figures, NumbersBecomeADensity) {
    HistogramFigure figure;
    figure.path = "/x";
    figure.counted = false;
    figure.bins = 4;
    Eigen::VectorXd values(6);
    values << 0, 0.1, 0.2, 1.9, 2, 4;
    const Drawing drawing = histogram(figure)({source_of({io::vector("/x", values, "m", "x")}, "a")});
    const Series& series = drawing.panels.at(0).series.at(0);
    EXPECT_EQ(series.x, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
    EXPECT_EQ(series.y, (std::vector<double>{3 / 6.0, 1 / 6.0, 1 / 6.0, 1 / 6.0}));
    EXPECT_EQ(drawing.panels[0].x.unit, "m");
}

TEST(Figures, ACurveNeedsAsManyNumbersOfBoth) {
    CurveFigure figure;
    figure.x = "/x";
    figure.y = "/y";
    const auto source =
        source_of({io::vector("/x", Eigen::Vector3d(1, 2, 3), "m", "x"), io::vector("/y", Eigen::Vector2d(1, 2), "1", "y")}, "a");
    EXPECT_THROW(curve(figure)({source}), InputError);
    figure.y = "/x";
    EXPECT_EQ(curve(figure)({source}).panels.at(0).y.unit, "m");
    figure.y_error = "/y";
    EXPECT_THROW(curve(figure)({source}), InputError);
}

TEST(Figures, ACurveMayHaveErrorsAndASecondOneBeside) {
    const Eigen::Vector3d x(1, 2, 3), y(4, 5, 6), error(0.1, 0.2, 0.3), fit(4.1, 5.1, 5.9);
    CurveFigure figure;
    figure.x = "/x";
    figure.y = "/y";
    figure.y_error = "/error";
    figure.other = "/fit";
    figure.other_name = "fit";
    figure.name = "values";
    const std::vector<io::Dataset> measured = {io::vector("/x", x, "m", "x"), io::vector("/y", y, "1", "y")};
    std::vector<io::Dataset> complete = measured;
    complete.push_back(io::vector("/error", error, "1", "e"));
    complete.push_back(io::vector("/fit", fit, "1", "f"));
    const Chart chart = curve(figure)({source_of(complete, "a"), source_of(measured, "b")}).panels.at(0);
    ASSERT_EQ(chart.series.size(), 5U);
    EXPECT_EQ(chart.series[0].error, (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_TRUE(chart.series[1].error.empty());
    EXPECT_EQ(chart.series[2].y, (std::vector<double>{4.1, 5.1, 5.9}));
    for (const auto& [k, name] : {std::pair(3U, "values"), std::pair(4U, "fit")}) {  // neither of one file nor of the other
        EXPECT_EQ(chart.series[k].name, name);
        EXPECT_TRUE(chart.series[k].key_only);
        EXPECT_EQ(chart.series[k].colour, -1);
    }
    const Chart alone = curve(figure)({source_of(complete, "a")}).panels.at(0);
    ASSERT_EQ(alone.series.size(), 2U);
    EXPECT_EQ(alone.series[0].name + ", " + alone.series[1].name, "values, fit");
}

TEST(Figures, ThePowerLawThroughModuliIsTheirLaw) {
    std::vector<FigureSource> sources;
    for (const double a : {0.32, 0.35, 0.4, 0.45, 0.5, 0.6}) {
        sources.push_back(source_of(moduli(a, 3e6 * std::pow(a - 0.3, 0.4)), "s", "generate vem"));
    }
    const Drawing drawing = draw_figure(figure_named("modulus-heterogeneity"), sources, true);
    const std::vector<Series>& series = drawing.panels.at(0).series;
    ASSERT_EQ(series.size(), 5U);  // structures, fit, a0, published VEM and BD
    EXPECT_EQ(series[0].name, "VEM");
    EXPECT_TRUE(series[0].per_structure);
    for (std::size_t k = 10; k < series[1].x.size(); ++k) {
        EXPECT_NEAR(series[1].y[k], 3e6 * std::pow(series[1].x[k] - 0.3, 0.4), 3e4);
    }
    EXPECT_NEAR(series[2].x[0], 0.3, 1e-3);
    EXPECT_EQ(series[3].x.size() + series[4].x.size(), 11U);
}

TEST(Figures, FewStructuresHaveNoFit) {
    const std::vector<FigureSource> sources = {source_of(moduli(0.4, 1e6), "one"), source_of(moduli(0.5, 2e6), "two")};
    const Drawing drawing = draw_figure(figure_named("modulus-heterogeneity"), sources, false);
    EXPECT_EQ(drawing.panels.at(0).series.size(), 2U);
    EXPECT_NE(drawing.caption.find("no power law"), std::string::npos);
}

TEST(Figures, PublishedStructuresAreThoseOfTheTable) {
    const auto rows = published_structures();
    ASSERT_EQ(rows.size(), 11U);
    EXPECT_DOUBLE_EQ(rows.front().a, 0.594);
    EXPECT_DOUBLE_EQ(rows.front().coordination, 4.68);
    EXPECT_DOUBLE_EQ(rows.back().parameter, 15);
    EXPECT_DOUBLE_EQ(rows.back().modulus, 1.62e6);
    EXPECT_DOUBLE_EQ(rows.back().spread, 0.213e6);
}

TEST(Figures, OneFileFiguresRefuseMore) {
    const std::vector<FigureSource> two = {source_of({}, "a"), source_of({}, "b")};
    EXPECT_THROW(draw_figure(figure_named("packing"), two, false), InputError);
    EXPECT_THROW(draw_figure(figure_named("packing"), {two[0]}, true), InputError);  // nothing is published
}

TEST(PaperFigures, SayWhatIsMissing) {
    const auto figures = draw_paper_figures({source_of(moduli(0.4, 1e6), "one")});
    ASSERT_EQ(figures.size(), 6U);
    EXPECT_TRUE(figures[5].drawing.has_value());
    EXPECT_FALSE(figures[1].drawing.has_value());  // no coordination number
    EXPECT_NE(figures[1].missing.at(0).find("coagula characterize one.h5"), std::string::npos);
    EXPECT_NE(figures[3].missing.at(0).find("--method dem"), std::string::npos);
    EXPECT_NE(figures[4].missing.at(0).find("coagula calibrate"), std::string::npos);
}

}  // namespace
