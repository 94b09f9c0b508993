// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of files that may be damaged, in a child process: HDF5 1.10 and FreeXL crash on some of them or never come back.
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <functional>
#include <string>

namespace coagula::io {

/// The limits of time and memory under which a child process reads a file.
class ReadingLimits {
public:
    /// Sets the limits that a file of so many bytes needs at most.
    explicit ReadingLimits(std::uint64_t file_length);
    /// Ends the limits: the file has been read.
    void lift();
    bool lifted() const { return lifted_; }

private:
    rlimit time_{};    ///< as before
    rlimit memory_{};  ///< as before
    bool lifted_ = false;
};

/// What `work` returns, computed in a child process. Its time and memory are limited by the length of the file `path`.
///
/// InputError and std::runtime_error thrown by `work` reach the caller. When the child crashes or reaches a limit, the file is
/// damaged and InputError says so. `work` sees the memory of the caller as it is at the call, and nothing but its text comes back;
/// it must not start threads.
std::string run_in_child(const std::string& path, const std::function<std::string(ReadingLimits&)>& work);

}  // namespace coagula::io
