// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_bar.hpp"

#include "interruption.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>

namespace coagula::tools {

namespace {

/// Such as "40 s left", "12 min left", "3.5 h left".
std::string time_left(double seconds) {
    std::array<char, 32> text{};
    if (seconds < 100) {
        std::snprintf(text.data(), text.size(), "%.0f s left", seconds);
    } else if (seconds < 6000) {
        std::snprintf(text.data(), text.size(), "%.0f min left", seconds / 60);
    } else {
        std::snprintf(text.data(), text.size(), "%.1f h left", seconds / 3600);
    }
    return text.data();
}

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
        begin(stage, now);
        done_ = std::max(done_, std::clamp(fraction, 0.0, 1.0));
        const double done = done_;
        std::string bar(static_cast<std::size_t>(done * width), '#');
        bar.resize(width, '.');
        const std::string line = std::string(stage) + " [" + bar + "] " + std::to_string(static_cast<int>(100 * done)) + " %  " +
                                 estimate(now) + std::string(remark);
        std::fprintf(stderr, "\r%.100s\033[K", line.c_str());
        std::fflush(stderr);
        last_ = now;
        drawn_ = true;
    }

private:
    using Time = std::chrono::steady_clock::time_point;

    /// A stage begins where it goes on from, such as a checkpoint.
    void begin(std::string_view stage, Time now) {
        if (stage != stage_) {
            stage_ = stage;
            done_ = 0;
            first_done_ = -1;
            left_ = std::numeric_limits<double>::infinity();
            began_ = now;
        }
    }

    /// From the pace since the stage began; empty in its first two seconds and as long as it has not moved. It never grows: where
    /// the work is slower than before, it waits.
    std::string estimate(Time now) {
        if (first_done_ < 0) {
            first_done_ = done_;
        }
        const std::chrono::duration<double> elapsed = now - began_;
        if (elapsed.count() < 2 || done_ <= first_done_) {
            return "";
        }
        left_ = std::min(left_, elapsed.count() * (1 - done_) / (done_ - first_done_));
        return time_left(left_) + "  ";
    }

    Time last_;
    bool drawn_ = false;
    std::string stage_;
    double done_ = 0;         ///< of the stage; the bar never goes back
    double first_done_ = -1;  ///< when it began
    double left_ = 0;         ///< as shown [s]
    Time began_;
};

/// One line about a run that will take minutes, once its pace is known. Programs that run others read it in their log.
class Forecast {
public:
    explicit Forecast(std::string faster) : faster_(std::move(faster)) {}

    /// @return the line, where it is time to say it.
    std::string look(std::string_view stage, double fraction) {
        const auto now = std::chrono::steady_clock::now();
        if (said_ || stage != stage_) {
            stage_ = stage;
            first_ = fraction;
            began_ = now;
            return {};
        }
        const double elapsed = std::chrono::duration<double>(now - began_).count();
        if (elapsed < sure_after || fraction <= first_) {
            return {};
        }
        const double left = elapsed * (1 - fraction) / (fraction - first_);
        said_ = true;
        return left < worth_saying ? ""
                                   : "coagula: " + stage_ + ": about " + time_left(left) + " at the pace so far" +
                                         (faster_.empty() ? "" : "; " + faster_) + "\n";
    }

private:
    static constexpr double sure_after = 10;     // s
    static constexpr double worth_saying = 120;  // s

    std::string faster_;
    std::string stage_;
    double first_ = 0;
    bool said_ = false;
    std::chrono::steady_clock::time_point began_;
};

}  // namespace

Progress make_progress(bool quiet, std::string faster) {
    const auto bar = quiet || isatty(STDERR_FILENO) == 0 ? nullptr : std::make_shared<ProgressBar>();
    const auto forecast = quiet ? nullptr : std::make_shared<Forecast>(std::move(faster));
    return Progress([bar, forecast](std::string_view stage, double fraction, std::string_view remark) {
        if (const std::string line = forecast ? forecast->look(stage, fraction) : ""; !line.empty()) {
            std::fputs(((bar ? "\r\033[K" : "") + line).c_str(), stderr);
        }
        if (bar) {
            bar->draw(stage, fraction, remark);
        }
        return !interrupted();
    });
}

}  // namespace coagula::tools
