// SPDX-License-Identifier: GPL-3.0-or-later
// Text exports of TA Instruments TRIOS, separated by tabs or commas. Lines "key, value", sections in brackets, and then, per step,
//     [step]                                [step]
//     <name of the step>                    Step name  <name>
//     <headings>                            Number of points  <points>
//     <units>                               Variables   <headings>
//     <cells>                               Units       <units>
//                                           Data point  <cells>
// the second when exported for a LIMS, where the first column is a label. There is no public specification: this is what files of
// DHR and ARES-G2 show.
#include "export_dialect.hpp"
#include "measured_readers.hpp"

#include <algorithm>
#include <array>

namespace coagula::io {

namespace {

using Word = std::pair<std::string_view, LineRole>;

constexpr std::array words = {
    Word{"[step]", LineRole::section},
    Word{"step name", LineRole::title},
    Word{"number of points", LineRole::points},
    Word{"variables", LineRole::headings},
};

constexpr ExportDialect dialect{MeasuredFormat::trios, words, UnitsPlace::line_below, {}};

bool recognise(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(),
                       [](const std::string& line) { return role_of(dialect, first_word(line)) == LineRole::section; });
}

MeasuredFile read(const MeasuredText& text) {
    return read_export(text, dialect);
}

}  // namespace

const MeasuredReader trios_reader{MeasuredFormat::trios, "TRIOS", recognise, read};

}  // namespace coagula::io
