#include "chart_legend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

constexpr std::size_t entries_inside = 4;
// Of the standard size, 85 mm x 64 mm, in parts of the frame.
constexpr double line_height = 0.075;
constexpr double character_width = 0.026;
constexpr double sample_width = 0.2;

struct Corner {
    bool top;
    bool right;
};

/// Part of the frame, 0 to 1.
struct InFrame {
    double x;
    double y;
};

double part_of(const SettledAxis& axis, double value) {
    const double shown = value / axis.scale;
    return axis.axis.logarithmic ? std::log(shown / axis.low) / std::log(axis.high / axis.low)
                                 : (shown - axis.low) / (axis.high - axis.low);
}

bool has_line(const Series& series) {
    return series.mark != Mark::points && series.mark != Mark::open_points && series.mark != Mark::bars;
}

/// Where something is drawn, lines in short steps.
std::vector<InFrame> drawn_places(const Chart& chart, const ChartAxes& axes) {
    constexpr int steps = 16;
    std::vector<InFrame> all;
    for (const Series& series : chart.series) {
        const SettledAxis& y = series.second_axis ? axes.second : axes.y;
        bool first = true;
        InFrame last{};
        for (const std::size_t k : shown_places(chart, series)) {
            const InFrame here{part_of(axes.x, series.x[k]), part_of(y, series.y[k])};
            const double bar = series.error.empty() || !std::isfinite(series.error[k]) ? 0 : series.error[k];
            all.push_back(here);
            all.push_back({here.x, part_of(y, series.y[k] + bar)});
            const double from = series.mark == Mark::bars ? 0 : part_of(y, std::max(series.y[k] - bar, 0.0));
            all.push_back({here.x, std::isfinite(from) ? from : 0});
            for (int step = 1; !first && has_line(series) && step < steps; ++step) {
                const double along = static_cast<double>(step) / steps;
                all.push_back({last.x + along * (here.x - last.x), last.y + along * (here.y - last.y)});
            }
            last = here;
            first = false;
        }
    }
    return all;
}

bool is_in(const InFrame& place, const Corner& corner, double width, double height) {
    const double x = corner.right ? 1 - place.x : place.x;
    const double y = corner.top ? 1 - place.y : place.y;
    return x >= 0 && x < width && y >= 0 && y < height;
}

Corner preferred(Legend legend) {
    return {legend == Legend::top_right || legend == Legend::top_left,
            legend == Legend::top_right || legend == Legend::bottom_right};
}

void make_room_above(SettledAxis& axis, double part) {
    if (axis.axis.logarithmic) {
        axis.high *= std::pow(axis.high / axis.low, part / (1 - part));
    } else {
        axis.high += (axis.high - axis.low) * part / (1 - part);
    }
}

}  // namespace

std::string place_legend(const Chart& chart, ChartAxes& axes) {
    std::size_t entries = 0;
    std::size_t longest = 0;
    const bool alone = chart.series.size() == 1 && chart.series.front().per_structure;  // its one name says nothing new
    for (const Series& series : chart.series) {
        entries += series.name.empty() ? 0 : 1;
        longest = std::max(longest, series.name.size());
    }
    if (entries == 0 || alone) {
        return "unset key\n";
    }
    const std::string look =
        " Left reverse samplen 1.8 spacing 1.1 font ',7' width " + to_text(-0.15 * static_cast<double>(longest)) + "\n";
    if (entries > entries_inside) {
        return "set key above horizontal" + look;
    }
    const double width = std::min(0.95, sample_width + character_width * static_cast<double>(longest));
    const double height = 0.04 + line_height * static_cast<double>(entries);
    const std::vector<InFrame> places = drawn_places(chart, axes);
    std::array<Corner, 5> corners{{preferred(chart.legend), {true, true}, {true, false}, {false, true}, {false, false}}};
    const auto free = std::find_if(corners.begin(), corners.end(), [&](const Corner& corner) {
        return std::none_of(places.begin(), places.end(),
                            [&](const InFrame& place) { return is_in(place, corner, width, height); });
    });
    Corner corner = free == corners.end() ? corners.front() : *free;
    if (free == corners.end()) {
        corner.top = true;
        make_room_above(axes.y, height);
        if (axes.has_second) {
            make_room_above(axes.second, height);
        }
    }
    return std::string("set key inside ") + (corner.top ? "top " : "bottom ") + (corner.right ? "right" : "left") + " vertical" +
           look;
}

}  // namespace coagula::report
