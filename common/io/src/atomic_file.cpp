#include <coagula/io/atomic_file.hpp>

#include <coagula/io/structure_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace coagula::io {

namespace {

constexpr mode_t private_mode = 0600;
constexpr mode_t usual_mode = 0666;

/// Where a symbolic link leads: the rename must replace the file, not the link.
std::filesystem::path behind_links(const std::string& path) {
    std::error_code ignored;
    const std::filesystem::path resolved =
        std::filesystem::is_symlink(path, ignored) ? std::filesystem::canonical(path, ignored) : "";
    return resolved.empty() ? std::filesystem::path(path) : resolved;
}

std::filesystem::path hidden_name(const std::filesystem::path& target) {
    return target.parent_path() / ("." + target.filename().string() + ".tmp");
}

bool is_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path.empty() ? "." : path, ignored);
}

[[noreturn]] void throw_exists(const std::string& path) {
    throw InputError(path + " exists already; give --force to overwrite it");
}

/// Waits for the lock of an open file. False where the file system has no locks. It is not the lock by which HDF5 keeps readers
/// away (flock), and it ends when the last copy of the descriptor is closed.
bool lock(int descriptor) {
    struct flock whole {};
    whole.l_type = F_WRLCK;
    whole.l_whence = SEEK_SET;
    int result = 0;
    do {
        result = fcntl(descriptor, F_OFD_SETLKW, &whole);
    } while (result != 0 && errno == EINTR);
    return result == 0;
}

/// True when the name still leads to the open file.
bool is_current(int descriptor, const std::filesystem::path& name) {
    struct stat opened {};
    struct stat named {};
    return fstat(descriptor, &opened) == 0 && lstat(name.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
           opened.st_ino == named.st_ino;
}

}  // namespace

void check_output(const std::string& path, bool overwrite) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    const auto folder = std::filesystem::path(path).parent_path();
    if (path.empty()) {
        throw InputError("the name of the output file is empty");
    }
    if (std::filesystem::exists(status)) {
        if (!std::filesystem::is_regular_file(status)) {
            throw InputError("cannot write " + path + ": it is not a regular file");
        }
        if (!overwrite) {
            throw_exists(path);
        }
    } else if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
        throw InputError("cannot write " + path + ": there is no folder " + folder.string());
    }
}

OutputFile::OutputFile(const std::string& path, bool overwrite, Unopened /*unused*/)
    : target_(behind_links(path)), name_(hidden_name(target_)), overwrite_(overwrite) {}

// It goes through another constructor so that the destructor cleans up behind an exception.
OutputFile::OutputFile(const std::string& path, bool overwrite) : OutputFile(path, overwrite, Unopened()) {
    check_output(path, overwrite);
    while (!open_locked()) {
    }
    owned_ = true;
    check_output(path, overwrite);  // another process may have written it meanwhile
}

OutputFile::~OutputFile() {
    if (owned_) {
        unlink(name_.c_str());  // before the lock ends
    }
    close_descriptor();
}

/// Makes the hidden file and locks it. False when that must be tried again, because another process had the lock or left the file.
bool OutputFile::open_locked() {
    const mode_t mode = access(target_.c_str(), F_OK) == 0 ? private_mode : usual_mode;
    descriptor_ = open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    const bool made = descriptor_ >= 0;
    if (!made) {
        descriptor_ = errno == EEXIST ? open(name_.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC) : -1;
    }
    if (descriptor_ < 0) {
        if (errno != ENOENT || !is_folder(name_.parent_path())) {
            fail();
        }
        return false;  // renamed or removed in between
    }
    const bool locked = lock(descriptor_);
    if (!locked && !made) {
        throw InputError("cannot write " + target_.string() + ": " + name_.string() +
                         " is of another run or left by a killed one; remove it when no run is writing");
    }
    if (is_current(descriptor_, name_)) {
        if (made) {
            return true;
        }
        if (unlink(name_.c_str()) != 0) {
            fail();
        }
    }
    close_descriptor();
    return false;
}

void OutputFile::write(std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            fail();
        }
    }
}

/// Where the group cannot be kept, another one gets no more than everybody has.
void OutputFile::keep_owner_and_mode() const {
    struct stat old {};
    if (stat(target_.c_str(), &old) != 0) {
        return;
    }
    mode_t mode = old.st_mode & 07777;
    if (fchown(descriptor_, old.st_uid, old.st_gid) != 0 && fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid) != 0) {
        mode = (mode & ~static_cast<mode_t>(070)) | (mode & (mode << 3) & 070);
    }
    if (fchmod(descriptor_, mode) != 0) {
        fail();
    }
}

void OutputFile::rename_to_target() {
    int result = overwrite_ ? -1 : renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE);
    if (result != 0 && !overwrite_ && errno == EEXIST) {
        throw_exists(target_.string());
    }
    if (result != 0 && (overwrite_ || errno == EINVAL || errno == ENOSYS)) {  // not every file system can do without replacing
        result = std::rename(name_.c_str(), target_.c_str());
    }
    if (result != 0) {
        fail();
    }
}

void OutputFile::publish() {
    keep_owner_and_mode();
    if (fsync(descriptor_) != 0) {
        fail();
    }
    rename_to_target();
    owned_ = false;
    close_descriptor();
}

void OutputFile::close_descriptor() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
    descriptor_ = -1;
}

void OutputFile::fail() const {
    const int reason = errno;
    throw std::runtime_error("cannot write " + target_.string() + ": " + std::generic_category().message(reason));
}

void write_file(const std::string& path, std::span<const char> bytes, bool overwrite) {
    OutputFile file(path, overwrite);
    file.write(bytes);
    file.publish();
}

}  // namespace coagula::io
