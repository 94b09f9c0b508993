// Pictures by the program gnuplot, as SVG to stand inside a page.
#pragma once

#include <string>

namespace coagula::report {

struct GnuplotOutput {
    std::string picture;
    std::string problem;  ///< why there is no picture, one clause; empty while there is one
};

/// What gnuplot writes for these commands. All goes through memory: no file is named in the commands, so that no name is read as
/// one.
/// @param commands beginning with those that set the terminal.
GnuplotOutput run_gnuplot(const std::string& commands);

/// The SVG without gnuplot's names of curves, which a browser would show under the mouse.
std::string without_names(std::string svg);

/// Draws with gnuplot, if it is installed; asks for it once.
class Gnuplot {
public:
    /// The <svg> element that the commands draw, its ids unique in the page; empty where nothing could be drawn, see problem().
    /// @param commands after the terminal has been set. @param title in words, for those who cannot see it.
    std::string draw(const std::string& commands, int width, int height, const std::string& title);

    /// One sentence why pictures are missing; empty while all could be drawn.
    const std::string& problem() const { return problem_; }

private:
    std::string problem_;
    int drawn_ = 0;
};

}  // namespace coagula::report
