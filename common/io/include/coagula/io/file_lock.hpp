// SPDX-License-Identifier: GPL-3.0-or-later
// A file belongs to one process at a time.
#pragma once

#include <coagula/io/output_place.hpp>
#include <coagula/io/unfinished_file.hpp>

#include <optional>
#include <string>

namespace coagula::io {

/// Exclusive use of a file: the hidden file .NAME.ENDING beside it is locked by whoever has it, and removed at the end. The kernel
/// releases the lock of a killed process. Where the file system has no locks, everybody gets it.
class FileLock {
public:
    FileLock(const OutputPlace& place, const std::string& ending);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock();

    /// False while another process has it. Throws InputError where the hidden file cannot be made.
    bool try_take();
    /// Waits for it. Throws Cancelled when a signal arrives meanwhile.
    void take();
    /// Whether a process that had it was killed.
    bool was_left() const { return left_; }

private:
    enum class Outcome { taken, busy, again };
    Outcome attempt();
    bool is_current() const;

    const OutputPlace& place_;
    std::string name_;
    int descriptor_ = -1;
    std::optional<UnfinishedFile> unfinished_;  ///< while this process has it
    bool left_ = false;
};

}  // namespace coagula::io
