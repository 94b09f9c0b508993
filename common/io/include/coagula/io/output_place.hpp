// SPDX-License-Identifier: GPL-3.0-or-later
// Where a file is to be made, found once: whatever others do to names and links meanwhile, it is made there.
#pragma once

#include <filesystem>
#include <string>

namespace coagula::io {

/// The folder of a file, held open, and the name of the file in it. Symbolic links are followed to the file itself.
class OutputPlace {
public:
    /// Throws InputError ("cannot write PATH: ...") where there is no such folder, the name is too long, or a link leads there that
    /// another user has put into a folder in which others may write.
    explicit OutputPlace(const std::string& path);
    OutputPlace(const OutputPlace&) = delete;
    OutputPlace& operator=(const OutputPlace&) = delete;
    ~OutputPlace();

    const std::string& path() const { return path_; }
    int folder() const { return folder_; }
    const std::filesystem::path& folder_name() const { return folder_name_; }
    const std::string& name() const { return name_; }
    bool exists() const;
    /// Throws InputError unless a file can be made or, with `overwrite`, replaced here.
    void check(bool overwrite) const;
    /// Brings the entries of the folder to the disk.
    void sync() const;
    /// "cannot write PATH: reason", the reason that of errno, as std::runtime_error.
    [[noreturn]] void fail() const;
    /// The same where the reason lies in the folder, as InputError.
    [[noreturn]] void fail_in_folder() const;
    [[noreturn]] void refuse(const std::string& reason) const;

private:
    std::string path_;  ///< as given
    std::filesystem::path folder_name_;
    std::string name_;
    int folder_ = -1;
};

}  // namespace coagula::io
