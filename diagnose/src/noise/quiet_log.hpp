// SPDX-License-Identifier: GPL-3.0-or-later
// Ceres reports numerical trouble, which its callers see in what it returns, on standard error too.
#pragma once

#include <glog/logging.h>

#include <mutex>
#include <utility>

namespace coagula::diagnose {

/// No messages of Ceres but fatal ones while one of these lives, in any thread.
class QuietLog {
public:
    QuietLog() {
        const std::lock_guard lock(mutex);
        if (alive++ == 0) {
            before = std::exchange(FLAGS_minloglevel, google::GLOG_FATAL);
        }
    }
    ~QuietLog() {
        const std::lock_guard lock(mutex);
        if (--alive == 0) {
            FLAGS_minloglevel = before;
        }
    }
    QuietLog(const QuietLog&) = delete;
    QuietLog& operator=(const QuietLog&) = delete;

private:
    static inline std::mutex mutex;
    static inline int alive = 0;
    static inline int before = 0;
};

}  // namespace coagula::diagnose
