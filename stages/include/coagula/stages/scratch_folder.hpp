// SPDX-License-Identifier: GPL-3.0-or-later
// A folder for files that nobody keeps.
#pragma once

#include <filesystem>

namespace coagula::stages {

/// A folder of its own among the temporary files, removed with all that is in it at the end. Throws std::runtime_error where none
/// can be made.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace coagula::stages
