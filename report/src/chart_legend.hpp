// SPDX-License-Identifier: GPL-3.0-or-later
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

/// The frame of one chart, as far as legends must know it. [m]
struct Frame {
    double width = 0.068;
    double height = 0.05;
    double font_size = 7;  ///< of the legend [pt]
};

/// @param panels beside each other in the picture.
Frame frame_of(const PictureSize& size, std::size_t panels);

/// Font size of numbers and legends [pt].
double small_font(const PictureSize& size);

/// The name of a series, its middle left out where it is too long for the frame.
std::string fitted_name(const std::string& name, const Frame& frame);

/// Commands for the legend. Where every corner has data, the y axis is extended upwards to make room.
std::string place_legend(const Chart& chart, ChartAxes& axes, const Frame& frame = {});

}  // namespace coagula::report
