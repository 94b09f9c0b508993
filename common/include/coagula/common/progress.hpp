// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of long work, and the way to stop it.
#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace coagula {

/// Thrown out of long work when the progress callback asks for it to stop.
struct Cancelled : std::runtime_error {
    Cancelled() : std::runtime_error("interrupted: nothing was written") {}
};

/// Reports how far long work has come. A default-constructed Progress reports to nobody.
class Progress {
public:
    /// Receives the stage ("void expansion"), the fraction done (0 to 1) and a short remark; returns false to cancel the work.
    using Callback = std::function<bool(std::string_view stage, double fraction, std::string_view remark)>;

    Progress() = default;
    explicit Progress(Callback callback) : callback_(std::move(callback)) {}

    /// Tells the callback; throws Cancelled if it answers false. Cheap enough for every few hundred microseconds of work.
    void update(std::string_view stage, double fraction, std::string_view remark = {}) const {
        if (callback_ && !callback_(stage, fraction, remark)) {
            throw Cancelled{};
        }
    }

private:
    Callback callback_;
};

}  // namespace coagula
