// SPDX-License-Identifier: GPL-3.0-or-later
#include "chart_legend.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::report {

namespace {

constexpr std::size_t entries_inside = 4;
constexpr double metres_per_point = 0.0254 / 72;
constexpr double digit_width =
    0.556;  // of Arial and its like, in heights of the font, as all widths here; gnuplot takes it for every letter
constexpr double sample_width = 5.5;  // of a line with its margins
constexpr double line_height = 1.5;

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

/// Width of a letter as in Arial, not less.
double letter_width(char32_t letter) {
    static const std::u32string narrow = U" !',./:;I[\\]fijlt|()-";
    static const std::u32string widest = U"mwMW@%";
    constexpr char32_t ideographs = 0x2e80;
    return letter >= ideographs                          ? 1.0
           : narrow.find(letter) != std::u32string::npos ? 0.33
           : widest.find(letter) != std::u32string::npos ? 0.944
           : (letter >= U'A' && letter <= U'Z')          ? 0.722
                                                         : digit_width;
}

/// The letters of a text in UTF-8.
std::vector<std::string> letters_of(const std::string& text) {
    std::vector<std::string> letters;
    for (const char byte : text) {
        constexpr unsigned continuing = 0x80;
        if (letters.empty() || (static_cast<unsigned char>(byte) & 0xc0U) != continuing) {
            letters.emplace_back();
        }
        letters.back() += byte;
    }
    return letters;
}

/// First bytes tell ideographs (three bytes from U+2E80 on, or four) well enough.
char32_t code_of(const std::string& letter) {
    const auto first = static_cast<unsigned char>(letter.front());
    return letter.size() == 1 ? first : first >= 0xe3 ? 0x3000 : 0xe9;
}

double text_width(const std::vector<std::string>& letters) {
    double width = 0;
    for (const std::string& letter : letters) {
        width += letter_width(code_of(letter));
    }
    return width;
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
    if (std::isfinite(axis.axis.high)) {
        return;  // it ends where the reader wants it to
    }
    if (axis.axis.logarithmic) {
        axis.high *= std::pow(axis.high / axis.low, part / (1 - part));
    } else {
        axis.high += (axis.high - axis.low) * part / (1 - part);
    }
}

}  // namespace

double small_font(const PictureSize& size) {
    return 0.875 * size.font_size;
}

Frame frame_of(const PictureSize& size, std::size_t panels) {
    const double axis = 5.5 * size.font_size * metres_per_point;  // its numbers and label
    return {.width = std::max(0.2 * size.width, size.width / static_cast<double>(panels) - axis - 0.005),
            .height = std::max(0.2 * size.height, size.height - axis),
            .font_size = small_font(size)};
}

std::string fitted_name(const std::string& name, const Frame& frame) {
    std::vector<std::string> letters = letters_of(name);
    const double room = 0.95 * frame.width / (frame.font_size * metres_per_point) - sample_width;
    if (text_width(letters) <= room) {
        return name;
    }
    while (letters.size() > 2 && text_width(letters) + 1 > room) {
        letters.erase(letters.begin() + static_cast<std::ptrdiff_t>(letters.size() / 2));
    }
    letters.insert(letters.begin() + static_cast<std::ptrdiff_t>((letters.size() + 1) / 2), "…");
    std::string fitted;
    for (const std::string& letter : letters) {
        fitted += letter;
    }
    return fitted;
}

std::string place_legend(const Chart& chart, ChartAxes& axes, const Frame& frame) {
    std::size_t entries = 0;
    std::size_t most_letters = 0;
    double widest = 0;
    const bool alone = chart.series.size() == 1 && chart.series.front().per_structure;  // its one name says nothing new
    for (const Series& series : chart.series) {
        const std::vector<std::string> letters = letters_of(fitted_name(series.name, frame));
        entries += series.name.empty() ? 0 : 1;
        most_letters = std::max(most_letters, letters.size());
        widest = std::max(widest, text_width(letters));
    }
    if (entries == 0 || alone) {
        return "unset key\n";
    }
    // gnuplot takes all letters to be as wide as digits.
    const std::string look = " Left reverse samplen 1.8 spacing 1.1 font '," + to_text(frame.font_size) + "' width " +
                             to_text(widest / digit_width - static_cast<double>(most_letters)) + "\n";
    if (entries > entries_inside) {
        return "set key above horizontal" + look;
    }
    const double em = frame.font_size * metres_per_point;
    const double width = std::min(1.0, (sample_width + widest) * em / frame.width);
    const double height = (0.5 + line_height * static_cast<double>(entries)) * em / frame.height;
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
