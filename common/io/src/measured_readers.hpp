// SPDX-License-Identifier: GPL-3.0-or-later
// One reader per format; measured_file.cpp lists them.
#pragma once

#include "measured_text.hpp"

namespace coagula::io {

/// Whether the text is an export of this program, and its tables.
struct MeasuredReader {
    MeasuredFormat format;
    std::string_view name;
    bool (*recognises)(const MeasuredText&);
    MeasuredFile (*read)(const MeasuredText&);
};

extern const MeasuredReader rheocompass_reader;
extern const MeasuredReader rheoplus_reader;
extern const MeasuredReader trios_reader;
extern const MeasuredReader trios_json_reader;
extern const MeasuredReader rheowin_reader;
/// CSV whose units stand in brackets below its headings.
extern const MeasuredReader units_line_reader;
extern const MeasuredReader csv_reader;

}  // namespace coagula::io
