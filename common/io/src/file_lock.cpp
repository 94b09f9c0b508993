// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/file_lock.hpp>

#include <coagula/common/progress.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

namespace coagula::io {

namespace {

constexpr long pause_nanoseconds = 10'000'000;

/// Nothing but a signal that has a handler ends a sleep early, whatever the handler does about calls that go on.
void pause_unless_signalled() {
    const timespec time{0, pause_nanoseconds};
    if (nanosleep(&time, nullptr) != 0 && errno == EINTR) {
        throw Cancelled();
    }
}

}  // namespace

FileLock::FileLock(const OutputPlace& place, const std::string& ending) : place_(place), name_("." + place.name() + "." + ending) {}

FileLock::~FileLock() {
    if (descriptor_ >= 0) {
        unlinkat(place_.folder(), name_.c_str(), 0);  // before the lock ends
        close(descriptor_);
    }
}

/// Whether the name still leads to the open file.
bool FileLock::is_current() const {
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor_, &opened) == 0 && fstatat(place_.folder(), name_.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// It is to be tried again when the process before has just removed the file. The lock is not the one by which HDF5 keeps readers
/// away (flock).
FileLock::Outcome FileLock::attempt() {
    constexpr int flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    descriptor_ = openat(place_.folder(), name_.c_str(), flags | O_CREAT | O_EXCL, 0600);
    left_ = descriptor_ < 0 && errno == EEXIST;
    if (left_) {
        descriptor_ = openat(place_.folder(), name_.c_str(), flags);
        if (descriptor_ < 0 && errno == ENOENT) {
            return Outcome::again;
        }
        if (descriptor_ < 0) {
            place_.refuse("its lock " + name_ + " cannot be taken: " + std::generic_category().message(errno));
        }
    }
    if (descriptor_ < 0) {
        place_.fail_in_folder();
    }
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    const bool locked = fcntl(descriptor_, F_OFD_SETLK, &whole) == 0;
    const bool busy = !locked && (errno == EAGAIN || errno == EACCES);
    if (!busy && is_current()) {
        left_ = left_ && locked;
        unfinished_.emplace(place_.folder(), name_);
        return Outcome::taken;
    }
    close(std::exchange(descriptor_, -1));
    return busy ? Outcome::busy : Outcome::again;
}

bool FileLock::try_take() {
    constexpr int most_attempts = 1000;
    Outcome outcome = Outcome::again;
    for (int k = 0; k < most_attempts && outcome == Outcome::again; ++k) {
        outcome = attempt();
    }
    return outcome == Outcome::taken;
}

void FileLock::take() {
    while (!try_take()) {
        pause_unless_signalled();
    }
}

}  // namespace coagula::io
