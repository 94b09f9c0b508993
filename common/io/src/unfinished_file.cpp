// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/unfinished_file.hpp>

#include <unistd.h>

#include <array>
#include <utility>

namespace coagula::io {

namespace {

/// A signal handler reads it: no lock, and no memory that moves.
std::array<std::atomic<const UnfinishedFile*>, 64> unfinished{};

}  // namespace

UnfinishedFile::UnfinishedFile(int folder, std::string name) : folder_(folder), name_(std::move(name)) {
    for (std::atomic<const UnfinishedFile*>& entry : unfinished) {
        const UnfinishedFile* none = nullptr;
        if (entry.compare_exchange_strong(none, this)) {
            entry_ = &entry;
            return;
        }
    }
}

UnfinishedFile::~UnfinishedFile() {
    if (entry_ != nullptr) {
        *entry_ = nullptr;
    }
}

void remove_unfinished_files() noexcept {
    for (const std::atomic<const UnfinishedFile*>& entry : unfinished) {
        if (const UnfinishedFile* file = entry; file != nullptr) {
            unlinkat(file->folder_, file->name_.c_str(), 0);
        }
    }
}

}  // namespace coagula::io
