#include "potential_picture.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/report/gnuplot.hpp>

#include <algorithm>
#include <stdexcept>

namespace coagula::tools {

void check_picture_name(const std::string& path) {
    if (!path.ends_with(".png") && !path.ends_with(".svg")) {
        throw InputError("--picture: " + path + " must end in .png or .svg");
    }
}

void draw_potential(const std::string& path, const PotentialCurve& curve, bool overwrite) {
    check_picture_name(path);
    // The wells of contacts are far deeper than all else: the picture shows what lies above the secondary minimum.
    double highest = 1;
    for (std::size_t row = 0; row < curve.gap.size(); ++row) {
        highest = std::max(highest, curve.energy[row]);
    }
    std::string commands = std::string("set terminal ") + (path.ends_with(".png") ? "pngcairo" : "svg") +
                           " size 900,600\nset xlabel 'gap [nm]'\nset ylabel 'energy [k_B T]'\nset logscale x\nset grid\n" +
                           "unset key\nset yrange [-10:" + to_text(1.1 * highest) + "]\nplot '-' with lines linewidth 2\n";
    for (std::size_t row = 0; row < curve.gap.size(); ++row) {
        commands += to_text(1e9 * curve.gap[row]) + ' ' + to_text(curve.energy[row]) + '\n';
    }
    const report::GnuplotOutput output = report::run_gnuplot(commands + "e\nunset output\n");
    if (!output.problem.empty()) {
        throw std::runtime_error("the picture " + path + " is not drawn: " + output.problem);
    }
    io::write_file(path, output.picture, overwrite);
}

}  // namespace coagula::tools
