// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_image.hpp"

#include <fcntl.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>

namespace coagula::io::hdf5 {

FileImage::~FileImage() {
    if (data_ != nullptr) {
        munmap(data_, size_);
    }
}

char* FileImage::resize(std::size_t size) {
    if (size == size_) {
        return data_;
    }
    const bool grows_on_disk = descriptor_ >= 0 && size > size_ && error_ == 0;
    if (grows_on_disk) {  // or a signal would tell that the disk is full
        error_ = posix_fallocate(descriptor_, static_cast<off_t>(size_), static_cast<off_t>(size - size_));
    }
    if (error_ != 0) {
        return resize_in_memory(size);
    }
    const bool on_disk = descriptor_ >= 0;
    void* moved = data_ != nullptr ? mremap(data_, size_, size, MREMAP_MAYMOVE)
                                   : mmap(nullptr, size, PROT_READ | PROT_WRITE, on_disk ? MAP_SHARED : MAP_PRIVATE | MAP_ANONYMOUS,
                                          descriptor_, 0);
    if (moved == MAP_FAILED) {
        error_ = errno;
        return nullptr;
    }
    data_ = static_cast<char*>(moved);
    size_ = size;
    on_disk_ = on_disk ? size : 0;
    return data_;
}

/// The part on disk stays there and becomes the beginning of the new place.
char* FileImage::resize_in_memory(std::size_t size) {
    void* place = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) {
        return nullptr;
    }
    char* grown = static_cast<char*>(place);
    const std::size_t kept = std::min(size, size_);
    const std::size_t moved = std::min(size, on_disk_);
    if (moved > 0 && mremap(data_, moved, moved, MREMAP_MAYMOVE | MREMAP_FIXED, grown) == MAP_FAILED) {
        return nullptr;
    }
    std::copy(data_ + moved, data_ + kept, grown + moved);
    if (size_ > moved) {
        munmap(data_ + moved, size_ - moved);
    }
    data_ = grown;
    size_ = size;
    on_disk_ = moved;
    return data_;
}

}  // namespace coagula::io::hdf5
