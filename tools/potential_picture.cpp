#include "potential_picture.hpp"

#include <coagula/common/checks.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace coagula::tools {

namespace {

/// In single quotes, as gnuplot reads it.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        result += c == '\'' ? std::string("''") : std::string(1, c);
    }
    return result + "'";
}

}  // namespace

void draw_potential(const std::string& path, const PotentialCurve& curve) {
    const bool png = path.ends_with(".png");
    if (!png && !path.ends_with(".svg")) {
        throw InputError("--picture: " + path + " must end in .png or .svg");
    }
    // The wells of contacts are far deeper than all else: the picture shows what lies above the secondary minimum.
    double highest = 1;
    for (std::size_t row = 0; row < curve.gap.size(); ++row) {
        highest = std::max(highest, curve.energy[row]);
    }
    std::string script = std::string("set terminal ") + (png ? "pngcairo" : "svg") + " size 900,600\nset output " + quoted(path) +
                         "\nset xlabel 'gap [nm]'\nset ylabel 'energy [k_B T]'\nset logscale x\nset grid\nunset key\n" +
                         "set yrange [-10:" + to_text(1.1 * highest) + "]\nplot '-' with lines linewidth 2\n";
    for (std::size_t row = 0; row < curve.gap.size(); ++row) {
        script += to_text(1e9 * curve.gap[row]) + ' ' + to_text(curve.energy[row]) + '\n';
    }
    script += "e\n";
    // Without gnuplot the write fails, which shall be an error and no death.
    std::signal(SIGPIPE, SIG_IGN);
    FILE* const gnuplot = popen("gnuplot", "w");
    if (gnuplot == nullptr) {
        throw std::runtime_error("gnuplot cannot be started");
    }
    const bool written = std::fwrite(script.data(), 1, script.size(), gnuplot) == script.size();
    if (pclose(gnuplot) != 0 || !written) {
        throw std::runtime_error("gnuplot could not draw " + path);
    }
}

}  // namespace coagula::tools
