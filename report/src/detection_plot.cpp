#include "diagnosis_plots.hpp"

#include "plot_parts.hpp"

#include <algorithm>
#include <vector>

namespace coagula::report {

std::string draw_detection(Gnuplot& gnuplot, const diagnose::Diagnosis& diagnosis) {
    if (diagnosis.bootstrap.empty() || diagnosis.statistics.empty()) {
        return {};
    }
    const double observed = diagnosis.statistics.front().score;
    const auto [low, high] = std::minmax_element(diagnosis.bootstrap.begin(), diagnosis.bootstrap.end());
    constexpr int bins = 40;
    const double width = std::max((*high - *low) / bins, 1e-9);
    std::vector<int> counts(bins, 0);
    for (const double score : diagnosis.bootstrap) {
        ++counts[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((score - *low) / width)))];
    }
    std::string block = "$drawn << EOD\n";
    for (int bin = 0; bin < bins; ++bin) {
        block += line_of({*low + (bin + 0.5) * width, static_cast<double>(counts[static_cast<std::size_t>(bin)])});
    }
    const double most = *std::max_element(counts.begin(), counts.end());
    const std::string place = to_text(observed);
    const double right = std::max(*high, observed) + 4 * width;
    const bool at_right = observed > *low + 0.6 * (right - *low);
    return gnuplot.draw(
        palette + block + "EOD\nset boxwidth " + to_text(0.92 * width) + "\nset style fill solid 1 noborder\nset yrange [0:" +
            to_text(1.15 * most) + "]\nset xrange [" + to_text(*low - width) + ":" + to_text(right) +
            "]\nset xlabel \"largest standardised misfit\"\nset ylabel \"drawn data sets\"\nunset key\nset arrow from " + place +
            ",0 to " + place + ",graph 0.94 nohead linecolor rgb base linewidth 2.4\nset label \"the data\" at " + place +
            ",graph 0.96 " + (at_right ? "right offset -0.6,0" : "left offset 0.6,0") +
            " textcolor rgb base\nplot $drawn using 1:2 with boxes linecolor rgb \"#b9c2c9\"\n",
        1080, 260, "Misfit of the data beside that of data sets drawn from the base model");
}

}  // namespace coagula::report
