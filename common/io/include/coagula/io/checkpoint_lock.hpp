// SPDX-License-Identifier: GPL-3.0-or-later
// A checkpoint belongs to one run at a time.
#pragma once

#include <coagula/io/file_lock.hpp>

#include <string>

namespace coagula::io {

/// Holds a checkpoint as long as it lives, whether or not the file is there yet.
class CheckpointLock {
public:
    /// Throws InputError while another run holds it, and where no checkpoint could be written.
    explicit CheckpointLock(const std::string& checkpoint);

private:
    OutputPlace place_;
    FileLock lock_;
};

}  // namespace coagula::io
