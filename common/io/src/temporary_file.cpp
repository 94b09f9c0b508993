// SPDX-License-Identifier: GPL-3.0-or-later
#include "temporary_file.hpp"

#include <coagula/common/checks.hpp>

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace coagula::io {

namespace {

namespace fs = std::filesystem;

constexpr mode_t private_mode = 0600;
constexpr mode_t usual_mode = 0666;
constexpr std::size_t random_digits = 12;
constexpr const char* ending = ".tmp";

std::string beginning(const OutputPlace& place) {
    return "." + place.name() + ".";
}

std::string random_name(const OutputPlace& place) {
    std::uint64_t number = 0;
    if (getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
        place.fail();
    }
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(number));
    return beginning(place) + std::string(digits.data(), random_digits) + ending;
}

bool is_random_name(const std::string& name, const std::string& begin) {
    return name.size() == begin.size() + random_digits + std::strlen(ending) && name.starts_with(begin) && name.ends_with(ending) &&
           name.find_first_not_of("0123456789abcdef", begin.size()) == begin.size() + random_digits;
}

}  // namespace

TemporaryFile::TemporaryFile(const OutputPlace& place) : place_(place) {
    constexpr int most_attempts = 100;  // each may meet a file of the same random name
    const mode_t mode = place.exists() ? private_mode : usual_mode;
    for (int attempt = 0; !make(mode); ++attempt) {
        if (errno != EEXIST || attempt == most_attempts) {
            place_.fail_in_folder();
        }
    }
}

bool TemporaryFile::make(mode_t mode) {
    name_ = random_name(place_);
    descriptor_ = openat(place_.folder(), name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    if (descriptor_ >= 0) {
        unfinished_.emplace(place_.folder(), name_);
    }
    return descriptor_ >= 0;
}

TemporaryFile::~TemporaryFile() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
    if (unfinished_) {
        unlinkat(place_.folder(), name_.c_str(), 0);
    }
}

void TemporaryFile::write(std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            place_.fail();
        }
    }
}

void TemporaryFile::finish(std::size_t size) {
    if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0 || fsync(descriptor_) != 0) {
        place_.fail();
    }
}

/// Where the group cannot be kept, another one gets no more than everybody has.
void TemporaryFile::keep_owner_and_mode() {
    struct stat old {};
    if (fstatat(place_.folder(), place_.name().c_str(), &old, AT_SYMLINK_NOFOLLOW) != 0) {
        return;
    }
    mode_t mode = old.st_mode & 07777;
    if (fchown(descriptor_, old.st_uid, old.st_gid) != 0 && fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid) != 0) {
        mode = (mode & ~static_cast<mode_t>(070)) | (mode & (mode << 3) & 070);
    }
    if (fchmod(descriptor_, mode) != 0) {
        place_.fail();
    }
}

void TemporaryFile::sync(std::span<const char> bytes) {
    if (fsync(descriptor_) != 0) {
        place_.fail();
    }
    struct stat found {};
    bool same = fstat(descriptor_, &found) == 0 && found.st_size == static_cast<off_t>(bytes.size());
    std::vector<char> buffer(std::min(bytes.size(), std::size_t{1} << 20));
    for (std::size_t done = 0; same && done < bytes.size();) {
        const ssize_t count =
            pread(descriptor_, buffer.data(), std::min(buffer.size(), bytes.size() - done), static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) {
            continue;
        }
        same = count > 0 && std::equal(buffer.begin(), buffer.begin() + count, bytes.begin() + static_cast<std::ptrdiff_t>(done));
        done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
    if (!same) {
        throw std::runtime_error("cannot write " + place_.path() +
                                 ": what was read back is not what was written; nothing was replaced");
    }
}

/// Where the file system has neither a rename that replaces nothing nor hard links, a plain rename follows the check.
bool TemporaryFile::rename_to_new() const {
    const int folder = place_.folder();
    const char* target = place_.name().c_str();
    if (renameat2(folder, name_.c_str(), folder, target, RENAME_NOREPLACE) == 0) {
        return true;
    }
    if (errno != EINVAL && errno != ENOSYS) {
        return false;
    }
    if (linkat(folder, name_.c_str(), folder, target, 0) == 0) {
        return unlinkat(folder, name_.c_str(), 0) == 0;
    }
    return errno != EEXIST && renameat2(folder, name_.c_str(), folder, target, 0) == 0;
}

void TemporaryFile::rename(bool overwrite) {
    const int folder = place_.folder();
    const bool renamed = overwrite ? renameat2(folder, name_.c_str(), folder, place_.name().c_str(), 0) == 0 : rename_to_new();
    if (!renamed) {
        const int reason = errno;
        if (reason == EEXIST) {
            place_.check(overwrite);
        }
        errno = reason;
        place_.fail();
    }
    unfinished_.reset();
}

void TemporaryFile::remove_leftovers(const OutputPlace& place) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(place.folder_name(), unreadable)) {
        const std::string name = entry.path().filename().string();
        if (is_random_name(name, beginning(place))) {
            unlinkat(place.folder(), name.c_str(), 0);
        }
    }
}

}  // namespace coagula::io
