// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/output_place.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/common/failures.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "temporary_file.hpp"

namespace coagula::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_entry = 255;  // NAME_MAX
constexpr mode_t anybody_may_write = S_IWUSR | S_IWGRP | S_IWOTH;

[[noreturn]] void refuse_path(const std::string& path, const std::string& reason) {
    throw InputError("cannot write " + path + ": " + reason);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// In a folder where others may write, anybody could make a link of this name that leads to a file of the user. This is the rule of
/// Linux for /tmp (fs.protected_symlinks), for every such folder.
bool is_trusted(const fs::path& link) {
    struct stat own {};
    struct stat folder {};
    return lstat(link.c_str(), &own) == 0 && stat(folder_of(link).c_str(), &folder) == 0 &&
           ((folder.st_mode & (S_IWGRP | S_IWOTH)) == 0 || own.st_uid == geteuid() || own.st_uid == folder.st_uid);
}

/// The place to which symbolic links lead; there need not be a file.
fs::path behind_links(const std::string& path) {
    constexpr int most_links = 40;
    fs::path place = path;
    std::error_code ignored;
    for (int links = 0; fs::is_symlink(place, ignored); ++links) {
        if (links == most_links) {
            refuse_path(path, "too many symbolic links lead to one another");
        }
        if (!is_trusted(place)) {
            refuse_path(
                path, "it is a symbolic link of another user in a folder where others may write; give the name of the file itself");
        }
        const fs::path target = fs::read_symlink(place, ignored);
        place = place.parent_path() / target;
    }
    return place;
}

std::string octal(mode_t mode) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%04o", static_cast<unsigned int>(mode & 07777));
    return text.data();
}

}  // namespace

OutputPlace::OutputPlace(const std::string& path) : path_(path) {
    if (path.empty()) {
        throw InputError("the name of the output file is empty");
    }
    const fs::path place = behind_links(path);
    folder_name_ = folder_of(place);
    name_ = place.filename().string();
    if (name_.empty() || name_ == "." || name_ == "..") {
        refuse("it is not a regular file");
    }
    const std::size_t longest = longest_entry - TemporaryFile::longer_by;
    if (name_.size() > longest) {
        refuse("the name has " + std::to_string(name_.size()) + " bytes, and " + std::to_string(longest) + " are possible");
    }
    folder_ = open(folder_name_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_ < 0 && errno == EACCES) {
        folder_ = open(folder_name_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);  // of a folder that cannot be listed
    }
    if (folder_ < 0) {
        if (errno == ENOENT || errno == ENOTDIR) {
            refuse("there is no folder " + folder_name_.string());
        }
        fail_in_folder();
    }
}

OutputPlace::~OutputPlace() {
    if (folder_ >= 0) {
        close(folder_);
    }
}

bool OutputPlace::exists() const {
    struct stat found {};
    return fstatat(folder_, name_.c_str(), &found, AT_SYMLINK_NOFOLLOW) == 0;
}

void OutputPlace::check(bool overwrite) const {
    struct stat found {};
    if (fstatat(folder_, name_.c_str(), &found, AT_SYMLINK_NOFOLLOW) != 0) {
        return;
    }
    if (!S_ISREG(found.st_mode)) {
        refuse("it is not a regular file");
    }
    if (!overwrite) {
        throw ExistsAlready(path_ + " exists already; give --force to overwrite it");
    }
    // A rename would replace it all the same, and so would root.
    if ((found.st_mode & anybody_may_write) == 0 || faccessat(folder_, name_.c_str(), W_OK, AT_EACCESS) != 0) {
        refuse("it is protected against writing (mode " + octal(found.st_mode) + "); 'chmod u+w' allows it");
    }
}

/// Some file systems have no fsync of folders.
void OutputPlace::sync() const {
    if (fsync(folder_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EBADF && errno != EROFS) {
        fail();
    }
}

void OutputPlace::fail() const {
    const int reason = errno;
    throw std::runtime_error("cannot write " + path_ + ": " + std::generic_category().message(reason));
}

void OutputPlace::fail_in_folder() const {
    const int reason = errno;
    if (reason == ENOSPC || reason == EDQUOT || reason == EMFILE || reason == ENFILE || reason == EIO) {
        fail();
    }
    const std::string folder = "the folder " + folder_name_.string();
    refuse(reason == EACCES || reason == EPERM ? "no permission to write in " + folder
           : reason == ENOENT                  ? "no file can be made in " + folder + "; it may have been removed"
                              : "no file can be made in " + folder + ": " + std::generic_category().message(reason));
}

void OutputPlace::refuse(const std::string& reason) const {
    refuse_path(path_, reason);
}

}  // namespace coagula::io
