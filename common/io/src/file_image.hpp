// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of a file while HDF5 builds it.
#pragma once

#include <cstddef>
#include <span>

namespace coagula::io::hdf5 {

/// Memory that grows: the process's own, or the pages of a file on disk, which the system writes out as it needs the room.
/// HDF5 1.10 crashes after an image could not grow, so that what finds no room on the disk goes on in memory, and error() says so.
class FileImage {
public:
    /// @param descriptor of a file open for reading and writing; none: own memory.
    explicit FileImage(int descriptor = -1) : descriptor_(descriptor) {}
    FileImage(const FileImage&) = delete;
    FileImage& operator=(const FileImage&) = delete;
    ~FileImage();

    /// The bytes from their beginning, those that were there kept and the new ones zero; null where there is no memory either.
    char* resize(std::size_t size);
    char* data() const { return data_; }
    /// Why the disk, or memory, had no room, as in errno; 0 if it had.
    int error() const { return error_; }

private:
    char* resize_in_memory(std::size_t size);

    int descriptor_;
    char* data_ = nullptr;
    std::size_t size_ = 0;
    std::size_t on_disk_ = 0;
    int error_ = 0;
};

}  // namespace coagula::io::hdf5
