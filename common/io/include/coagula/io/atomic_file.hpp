// Files that appear whole or not at all, and that two processes do not write at once.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace coagula::io {

/// A file on its way to `path`: the bytes go to the hidden file .NAME.tmp beside it, which takes the place of `path` when it is
/// complete. The hidden file is locked, so that one process at a time is between reading what `path` holds and replacing it; the
/// kernel releases the lock of a killed process, and the next one removes what it left.
class OutputFile {
public:
    /// Waits until no other process writes to `path`. Throws as check_output does, and std::runtime_error ("cannot write FILE:
    /// reason").
    OutputFile(const std::string& path, bool overwrite);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    /// Removes the hidden file unless it was published.
    ~OutputFile();

    void write(std::span<const char> bytes);
    /// Brings the bytes to the disk and renames the file. One that is replaced gives it its mode and, as far as allowed, its owner.
    void publish();

private:
    struct Unopened {};
    OutputFile(const std::string& path, bool overwrite, Unopened unopened);
    bool open_locked();
    void keep_owner_and_mode() const;
    void rename_to_target();
    void close_descriptor();
    [[noreturn]] void fail() const;

    std::filesystem::path target_;
    std::filesystem::path name_;
    bool overwrite_;
    int descriptor_ = -1;
    bool owned_ = false;  ///< the hidden file is that of this process and not published yet
};

/// Writes these bytes through an OutputFile. When it fails, nothing is left behind and an older `path` is untouched.
void write_file(const std::string& path, std::span<const char> bytes, bool overwrite);

}  // namespace coagula::io
