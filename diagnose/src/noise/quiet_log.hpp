// SPDX-License-Identifier: GPL-3.0-or-later
// Ceres reports numerical trouble, which its callers see in what it returns, on standard error too.
#pragma once

#include <glog/logging.h>

namespace coagula::diagnose {

/// No messages of Ceres but fatal ones while it lives.
class QuietLog {
public:
    QuietLog() { FLAGS_minloglevel = google::GLOG_FATAL; }
    ~QuietLog() { FLAGS_minloglevel = before_; }
    QuietLog(const QuietLog&) = delete;
    QuietLog& operator=(const QuietLog&) = delete;

private:
    int before_ = FLAGS_minloglevel;
};

}  // namespace coagula::diagnose
