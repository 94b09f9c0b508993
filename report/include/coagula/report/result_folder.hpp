// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of results that belong together: they appear at once, after all of them have been written.
#pragma once

#include <coagula/io/file_lock.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace coagula::report {

/// Files are first written into the hidden folder .new inside the target; whatever fails meanwhile leaves the target as it was.
/// When all of them are on the disk, `publish` renames .new to .whole, and from there they go to their places. A run that is killed
/// on that way has lost nothing: the next one that names the folder goes on. The key file goes first and comes last, so that where
/// it stands, all files are of one run. From the first file on the target is locked: another run waits, then removes what a killed
/// one left.
class ResultFolder {
public:
    /// Throws InputError when `folder` is a file, or one of the files is a folder, or is there already and `force` is not given.
    /// Nothing is made yet.
    /// @param others what else will be written, but for what may be there already.
    ResultFolder(std::filesystem::path folder, std::string key_file, std::vector<std::string> others, bool force);
    ResultFolder(const ResultFolder&) = delete;
    ResultFolder& operator=(const ResultFolder&) = delete;
    ~ResultFolder();

    const std::filesystem::path& path() const { return folder_; }
    /// The paths of the key file and the others.
    std::vector<std::filesystem::path> files() const;
    /// Where to write a file of this name until it is published.
    std::filesystem::path stage(const std::string& name);
    void write(const std::string& name, const std::string& text);
    /// Writes a file at its place at once, for the next run to go on from should this one be killed.
    void keep(const std::string& name, const std::string& text);
    /// What an earlier run left under this name is removed on publishing.
    void withdraw(const std::string& name) { withdrawn_.push_back(name); }
    void publish();

private:
    void refuse_existing() const;
    void begin();
    void lock();
    void put_in_place() const;
    void move(const std::string& name) const;

    std::filesystem::path folder_;
    std::string key_file_;
    std::vector<std::string> others_;
    bool force_;
    std::filesystem::path staging_;
    std::filesystem::path whole_;
    std::optional<io::OutputPlace> key_place_;
    std::optional<io::FileLock> lock_;
    bool made_ = false;  ///< the folder itself, by this run
    std::vector<std::string> withdrawn_;
};

}  // namespace coagula::report
