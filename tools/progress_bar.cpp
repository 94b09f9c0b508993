#include "progress_bar.hpp"

#include "interruption.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

namespace coagula::tools {

namespace {

/// One line that is drawn over again and wiped at the end.
class ProgressBar {
public:
    ~ProgressBar() {
        if (drawn_) {
            std::fputs("\r\033[K", stderr);
        }
    }
    ProgressBar() = default;
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void draw(std::string_view stage, double fraction, std::string_view remark) {
        const auto now = std::chrono::steady_clock::now();
        if (drawn_ && now - last_ < std::chrono::milliseconds(100)) {
            return;
        }
        constexpr int width = 30;
        const double done = std::clamp(fraction, 0.0, 1.0);
        std::string bar(static_cast<std::size_t>(done * width), '#');
        bar.resize(width, '.');
        const std::string line =
            std::string(stage) + " [" + bar + "] " + std::to_string(static_cast<int>(100 * done)) + " %  " + std::string(remark);
        std::fprintf(stderr, "\r%.100s\033[K", line.c_str());
        std::fflush(stderr);
        last_ = now;
        drawn_ = true;
    }

private:
    std::chrono::steady_clock::time_point last_;
    bool drawn_ = false;
};

}  // namespace

Progress make_progress(bool quiet) {
    const auto bar = quiet || isatty(STDERR_FILENO) == 0 ? nullptr : std::make_shared<ProgressBar>();
    return Progress([bar](std::string_view stage, double fraction, std::string_view remark) {
        if (bar) {
            bar->draw(stage, fraction, remark);
        }
        return !interrupted();
    });
}

}  // namespace coagula::tools
