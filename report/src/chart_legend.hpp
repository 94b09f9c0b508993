// Where the legend of a chart stands: in a corner where no data are.
#pragma once

#include "chart_axis.hpp"

#include <string>

namespace coagula::report {

/// The axes of one chart.
struct ChartAxes {
    SettledAxis x;
    SettledAxis y;
    SettledAxis second;
    bool has_second = false;
};

/// Commands for the legend. Where every corner has data, the y axis is extended upwards to make room.
std::string place_legend(const Chart& chart, ChartAxes& axes);

}  // namespace coagula::report
