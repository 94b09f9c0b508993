#include "checkpoint_lock.hpp"

#include <coagula/common/checks.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace coagula::tools {

namespace {

std::string lock_name(const std::filesystem::path& checkpoint) {
    std::error_code ignored;
    const std::filesystem::path target =
        std::filesystem::is_symlink(checkpoint, ignored) ? std::filesystem::weakly_canonical(checkpoint, ignored) : checkpoint;
    return (target.parent_path() / ("." + target.filename().string() + ".lock")).string();
}

/// Whether the name still leads to the open file.
bool is_current(int descriptor, const std::string& name) {
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor, &opened) == 0 && lstat(name.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

}  // namespace

CheckpointLock::CheckpointLock(const std::string& checkpoint) : name_(lock_name(checkpoint)) {
    while (!take(checkpoint)) {
    }
}

CheckpointLock::~CheckpointLock() {
    if (descriptor_ >= 0) {
        unlink(name_.c_str());  // before the lock ends
        close(descriptor_);
    }
}

/// False when that must be tried again, because the run before has just removed the file.
bool CheckpointLock::take(const std::string& checkpoint) {
    descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (descriptor_ < 0) {
        throw InputError("cannot write " + checkpoint + ": " + std::generic_category().message(errno));
    }
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    const bool taken = fcntl(descriptor_, F_OFD_SETLK, &whole) != 0 && (errno == EAGAIN || errno == EACCES);
    if (!taken && is_current(descriptor_, name_)) {
        return true;
    }
    close(std::exchange(descriptor_, -1));
    if (taken) {
        throw InputError("another run is using the checkpoint " + checkpoint +
                         ": wait for its end, or give this run a checkpoint of its own");
    }
    return false;
}

}  // namespace coagula::tools
