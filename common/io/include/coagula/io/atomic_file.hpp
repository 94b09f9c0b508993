// SPDX-License-Identifier: GPL-3.0-or-later
// Files that appear whole or not at all, and that two processes do not write at once. Every file of the house is written here.
#pragma once

#include <coagula/io/file_lock.hpp>
#include <coagula/io/output_place.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace coagula::io {

class TemporaryFile;

/// A file that is to be written by this process and by no other one meanwhile: one process at a time is between reading what `path`
/// holds and replacing it. The lock of a killed process ends with it, and the next one removes what it left.
class OutputFile {
public:
    /// Waits until no other process writes to `path`. Throws as check_output does, Cancelled when a signal arrives meanwhile, and
    /// std::runtime_error ("cannot write FILE: reason").
    OutputFile(const std::string& path, bool overwrite);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Writes the bytes to a hidden file beside, brings them to the disk, reads them back, renames the file and brings the folder
    /// to the disk. A file that is replaced gives the new one its mode and, as far as allowed, its owner. When anything fails,
    /// nothing is left behind and an older file is untouched.
    void publish(std::span<const char> bytes);

    /// Opens the hidden file for what is too large to lie in memory; whoever writes it need not close it.
    int open_in_place();
    /// The same with what was written there, so many bytes.
    void publish_in_place(std::size_t size);

private:
    void publish(TemporaryFile& file);

    OutputPlace place_;
    FileLock lock_;
    bool overwrite_;
    std::unique_ptr<TemporaryFile> in_place_;
};

/// Writes these bytes through an OutputFile.
void write_file(const std::string& path, std::span<const char> bytes, bool overwrite);

/// Removes a file where there is one; of a symbolic link the file to which it leads. Throws as OutputPlace does.
void remove_file(const std::string& path);

/// Makes a folder with those above it, and brings what is new to the disk. False when it was there already.
bool make_folder(const std::filesystem::path& path);

/// Brings the names in a folder to the disk.
void sync_folder(const std::filesystem::path& path);

}  // namespace coagula::io
