#include "atomic_file.hpp"

#include <coagula/io/structure_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace coagula::io {

namespace {

/// The temporary file: gone at the end of its life unless it has become the target.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::filesystem::path& target)
        : target_(target),
          name_(target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + ".tmp")),
          descriptor_(open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666)) {
        if (descriptor_ < 0) {
            fail();
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        close_descriptor();
        if (!renamed_) {
            unlink(name_.c_str());
        }
    }

    void write(std::span<const char> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written >= 0) {
                bytes = bytes.subspan(static_cast<std::size_t>(written));
            } else if (errno != EINTR) {
                fail();
            }
        }
    }

    void rename_to_target() {
        if (fsync(descriptor_) != 0 || close_descriptor() != 0 || std::rename(name_.c_str(), target_.c_str()) != 0) {
            fail();
        }
        renamed_ = true;
    }

private:
    int close_descriptor() {
        const int result = descriptor_ >= 0 ? close(descriptor_) : 0;
        descriptor_ = -1;
        return result;
    }

    [[noreturn]] void fail() const {
        const int reason = errno;
        throw std::runtime_error("cannot write " + target_.string() + ": " + std::generic_category().message(reason));
    }

    std::filesystem::path target_;
    std::filesystem::path name_;
    int descriptor_;
    bool renamed_ = false;
};

/// Where a symbolic link leads: the rename must replace the file, not the link.
std::filesystem::path behind_links(const std::string& path) {
    std::error_code ignored;
    const std::filesystem::path resolved =
        std::filesystem::is_symlink(path, ignored) ? std::filesystem::canonical(path, ignored) : "";
    return resolved.empty() ? std::filesystem::path(path) : resolved;
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
            throw InputError(path + " exists already; give --force to overwrite it");
        }
    } else if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
        throw InputError("cannot write " + path + ": there is no folder " + folder.string());
    }
}

void write_file(const std::string& path, std::span<const char> bytes, bool overwrite) {
    check_output(path, overwrite);
    TemporaryFile file(behind_links(path));
    file.write(bytes);
    file.rename_to_target();
}

}  // namespace coagula::io
