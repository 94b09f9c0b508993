// SPDX-License-Identifier: GPL-3.0-or-later
// Files that a program which is ended by force takes away with it.
#pragma once

#include <atomic>
#include <string>

namespace coagula::io {

/// A hidden file of this process that must not outlive it. It is entered where the file is made, and its entry ends with the file.
class UnfinishedFile {
public:
    /// @param folder descriptor of the folder, open as long as this lives.
    UnfinishedFile(int folder, std::string name);
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;
    ~UnfinishedFile();

private:
    friend void remove_unfinished_files() noexcept;

    int folder_;
    std::string name_;
    std::atomic<const UnfinishedFile*>* entry_ = nullptr;  ///< null where too many are being written
};

/// Removes the unfinished files of this process. A signal handler may call it, before _exit.
void remove_unfinished_files() noexcept;

}  // namespace coagula::io
