// SPDX-License-Identifier: GPL-3.0-or-later
// Text exports of Thermo HAAKE RheoWin:
//     C:\...\name.rwd
//     Date / Time / Version: ...
//     ;omega / rad/s;G' / Pa;G'' / Pa;
//     1|1;6,283;40,88;1,452;
// or ";omega in rad/s;...", in French "Nr-Seg;Om en 1/min;...". The label is that of series and point; all series stand below one
// line of headings. Older versions spell Greek letters.
#include "export_dialect.hpp"
#include "measured_readers.hpp"

#include <algorithm>
#include <array>

namespace coagula::io {

namespace {

using Heading = std::pair<std::string_view, std::string_view>;

constexpr std::array own_headings = {
    Heading{"gp", "shear rate"},  // gamma with a point
    Heading{"t_seg", "segment time"},
    Heading{"ga", "strain"},
    Heading{"da", "phase"},
};

constexpr ExportDialect dialect{MeasuredFormat::rheowin, {}, UnitsPlace::after_heading, own_headings};

/// "2|17" in front of a separator.
bool is_row(const std::string& line) {
    const std::string label = first_word(line);
    const std::size_t bar = label.find('|');
    return bar != std::string::npos && announced_count(label.substr(0, bar)) > 0 && announced_count(label.substr(bar + 1)) > 0;
}

bool recognise(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(), is_row);
}

MeasuredFile read(const MeasuredText& text) {
    return read_export(text, dialect);
}

}  // namespace

const MeasuredReader rheowin_reader{MeasuredFormat::rheowin, "RheoWin", recognise, read};

}  // namespace coagula::io
