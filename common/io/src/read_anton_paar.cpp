// SPDX-License-Identifier: GPL-3.0-or-later
// Exports of Anton Paar. RheoCompass, per interval:
//     Test:  <name>
//     Result:  <name>
//     Interval and data points:  <interval>  <points>
//     Interval data:  Point No.  <headings>
//                                <what distinguishes equal headings, such as Waveform; the line may be missing>
//                                <units in brackets>
//                     1          <cells>
// or "Interval:  <interval>" and headings without "Interval data:" and numbers of points.
// A point with a waveform is followed by lines without a number that carry the further samples of the waveform columns.
// RheoPlus, which came before it:
//     Data Series Information
//     Name:  <name>
//     Interval:  <interval>
//     Number of Data Points:  <points>
//     Meas. Pts.  <headings>
//                 <units in brackets>
//     1           <cells>
// There is no public specification: this is what English, German, French and Japanese files show. In other languages the tables are
// found by their line of units, but sections and names are not.
#include "export_dialect.hpp"
#include "measured_readers.hpp"

#include <algorithm>
#include <array>

namespace coagula::io {

namespace {

using Word = std::pair<std::string_view, LineRole>;

constexpr std::array rheocompass_words = {
    Word{"interval and data points", LineRole::section},
    Word{"abschnitt und datenpunkte", LineRole::section},
    Word{"intervalle et points de données", LineRole::section},
    Word{"interval", LineRole::section},
    Word{"abschnitt", LineRole::section},
    Word{"intervalle", LineRole::section},
    Word{"interval data", LineRole::headings},
    Word{"data interval", LineRole::headings},
    Word{"abschnittsdaten", LineRole::headings},
    Word{"interval données", LineRole::headings},
    Word{"intervalle données", LineRole::headings},
    Word{"project", LineRole::series},
    Word{"projekt", LineRole::series},
    Word{"projet", LineRole::series},
    Word{"test", LineRole::test},
    Word{"versuch", LineRole::test},
    Word{"essai", LineRole::test},
    Word{"result", LineRole::title},
    Word{"ergebnis", LineRole::title},
    Word{"résultat", LineRole::title},
};

constexpr std::array rheoplus_words = {
    Word{"data series information", LineRole::series},
    Word{"datenreihen-information", LineRole::series},
    Word{"データシリーズの情報", LineRole::series},
    Word{"name", LineRole::title},
    Word{"名前", LineRole::title},
    Word{"interval", LineRole::section},
    Word{"messabschnitt", LineRole::section},
    Word{"インターバル", LineRole::section},
    Word{"number of data points", LineRole::points},
    Word{"anzahl messpunkte", LineRole::points},
    Word{"データポイント数", LineRole::points},
    Word{"meas. pts.", LineRole::headings},
    Word{"messpkt.", LineRole::headings},
    Word{"測定点数", LineRole::headings},
};

constexpr ExportDialect rheocompass{MeasuredFormat::rheocompass, rheocompass_words, UnitsPlace::brackets_below, {}};
constexpr ExportDialect rheoplus{MeasuredFormat::rheoplus, rheoplus_words, UnitsPlace::brackets_below, {}};
constexpr ExportDialect any_language{MeasuredFormat::csv, {}, UnitsPlace::brackets_below, {}};

template <const ExportDialect& dialect>
MeasuredFile read(const MeasuredText& text) {
    return read_export(text, dialect);
}

/// Lines of sections and headings are in no other file.
template <const ExportDialect& dialect>
bool recognise(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(), [](const std::string& line) {
        const LineRole role = role_of(dialect, first_word(line));
        return role == LineRole::headings || (role == LineRole::section && line.find_first_of("\t;,") != std::string::npos);
    });
}

/// RheoPlus has intervals, too, but no results.
bool recognise_rheocompass(const MeasuredText& text) {
    bool result = false;
    bool plain_interval = false;
    for (const std::string& line : text.lines) {
        const std::string word = first_word(line);
        const LineRole role = role_of(rheocompass, word);
        const bool plain = word == "interval" || word == "abschnitt" || word == "intervalle";
        const bool section = role == LineRole::section && line.find_first_of("\t;,") != std::string::npos;
        if (role == LineRole::headings || (section && !plain)) {
            return true;
        }
        result = result || role == LineRole::title;
        plain_interval = plain_interval || section;
    }
    return result && plain_interval;
}

bool has_line_of_units(const MeasuredText& text) {
    return std::any_of(text.lines.begin(), text.lines.end(), [](const std::string& line) {
        return line.find('[') != std::string::npos && units_in_brackets(split_cells(line, separator_in(line))) > 1;
    });
}

}  // namespace

const MeasuredReader rheocompass_reader{MeasuredFormat::rheocompass, "RheoCompass", recognise_rheocompass, read<rheocompass>};
const MeasuredReader rheoplus_reader{MeasuredFormat::rheoplus, "RheoPlus", recognise<rheoplus>, read<rheoplus>};
const MeasuredReader units_line_reader{MeasuredFormat::csv, "CSV", has_line_of_units, read<any_language>};

}  // namespace coagula::io
