// SPDX-License-Identifier: GPL-3.0-or-later
// Figures 1 to 6 of Schenker, Filser, Hütter, Gauckler, Granular Matter 14 (2012) 333, from what is computed.
#include "figure_parts.hpp"

#include <algorithm>
#include <array>

namespace coagula::report {

namespace {

struct PaperEntry {
    int number;
    const char* figure;
    const char* remark;  ///< on what the paper shows
};
constexpr std::array<PaperEntry, 6> entries{
    {{1, "modulus-volume-fraction",
      "The paper shows measured moduli of alumina suspensions there; they are published as a picture only and are not drawn."},
     {2, "heterogeneity-coordination", "As fig. 2 of the paper."},
     {3, "rheometer", "As fig. 3 of the paper, a drawing without numbers."},
     {4, "oscillations", "As fig. 4 of the paper, whose points are published as a picture only and are not drawn."},
     {5, "modulus-stiffness",
      "As fig. 5 of the paper. Of its simulated points those at 100 N/m are published as numbers (table 2, 0 and 15 mV); its "
      "measured "
      "ones are not."},
     {6, "modulus-heterogeneity", "As fig. 6 of the paper, whose law has a0 = 0.373 and β = 0.187."}}};

bool fits(const Figure& figure, const FigureSource& source) {
    return figure.input == FigureInput::both || source.contents.has_value() == (figure.input == FigureInput::structures);
}

/// Why the file alone cannot be drawn; empty when it can.
std::string objection(const Figure& figure, const FigureSource& source) {
    try {
        figure.draw({source});
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// The structures of least and largest heterogeneity, coagulated ones if there are some: of these the paper's series is.
std::string calibration_command(const Sources& sources) {
    const FigureSource* least = nullptr;
    const FigureSource* most = nullptr;
    const std::string a = "/characterization/doh/a";
    for (const bool coagulated : {true, false}) {
        for (const FigureSource& source : sources) {
            const bool counts = source.contents && source.find(a) != nullptr &&
                                (!coagulated || (!source.contents->history.empty() &&
                                                 source.contents->history.front().stage == "generate brownian"));
            if (counts) {
                least = least == nullptr || source.number(a) < least->number(a) ? &source : least;
                most = most == nullptr || source.number(a) > most->number(a) ? &source : most;
            }
        }
        if (least != nullptr && least != most) {
            return "coagula calibrate " + least->file + " " + most->file + " -o stiffness.csv";
        }
        least = most = nullptr;
    }
    return "coagula calibrate HOMOGENEOUS.h5 HETEROGENEOUS.h5 -o stiffness.csv";
}

Sources usable(const Figure& figure, const Sources& sources, std::vector<std::string>& missing) {
    Sources found;
    for (const FigureSource& source : sources) {
        const bool enough = figure.one_file && !found.empty();
        if (enough || !fits(figure, source) || (figure.input == FigureInput::both && !source.contents)) {
            continue;
        }
        const std::string problem = objection(figure, source);
        if (problem.empty()) {
            found.push_back(source);
        } else {
            missing.push_back(problem);
        }
    }
    if (figure.one_file) {  // one file is enough, and the way to it is told once
        missing.resize(found.empty() ? std::min<std::size_t>(missing.size(), 1) : 0);
    }
    if (figure.input == FigureInput::tables) {  // other tables in the folder are none of its business
        missing.clear();
    }
    return found;
}

}  // namespace

std::vector<PaperFigure> draw_paper_figures(const Sources& sources) {
    std::vector<PaperFigure> drawn;
    for (const PaperEntry& entry : entries) {
        const Figure& figure = figure_named(entry.figure);
        PaperFigure result{.number = entry.number, .figure = figure.name};
        const Sources found = usable(figure, sources, result.missing);
        if (found.empty() && result.missing.empty()) {
            result.missing.push_back(figure.input == FigureInput::tables
                                         ? "there is no table of moduli over the stiffness: '" + calibration_command(sources) +
                                               "' writes it; give it too, or write it into the folder"
                                         : "there is no structure: 'coagula generate vem -o a.h5' makes one");
        } else if (!found.empty()) {
            try {
                result.drawing = draw_figure(figure, found, figure.published != nullptr);
                result.drawing->caption += std::string(" ") + entry.remark;
            } catch (const InputError& error) {
                result.missing.emplace_back(error.what());
            }
        }
        drawn.push_back(std::move(result));
    }
    return drawn;
}

}  // namespace coagula::report
