#include <coagula/report/result_folder.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/io/atomic_file.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace coagula::report {

namespace fs = std::filesystem;

ResultFolder::ResultFolder(fs::path folder, std::string key_file, std::vector<std::string> others, bool force)
    : folder_(std::move(folder)),
      key_file_(std::move(key_file)),
      others_(std::move(others)),
      force_(force),
      staging_(folder_ / ".new") {
    if (fs::exists(folder_) && !fs::is_directory(folder_)) {
        throw InputError(folder_.string() + " exists already and is not a folder");
    }
    refuse_existing();
}

ResultFolder::~ResultFolder() {
    if (lock_ >= 0) {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
        if (made_) {
            fs::remove(folder_, ignored);  // only if empty
        }
        close(lock_);
    }
}

void ResultFolder::refuse_existing() const {
    std::vector<std::string> names{key_file_};
    names.insert(names.end(), others_.begin(), others_.end());
    for (const std::string& name : names) {
        const fs::path path = folder_ / name;
        if (fs::is_directory(path)) {
            throw InputError(path.string() + " is a folder, but a file of this name is to be written");
        }
        if (fs::exists(path) && !force_) {
            throw InputError(path.string() + " is there already; use --force to replace it");
        }
    }
}

/// Makes and locks the folder.
void ResultFolder::begin() {
    std::error_code failed;
    made_ = fs::create_directories(folder_, failed);
    lock_ = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    while (lock_ >= 0 && flock(lock_, LOCK_EX) != 0 && errno == EINTR) {
    }
    if (lock_ >= 0 && !failed) {
        fs::remove_all(staging_, failed);
        fs::create_directory(staging_, failed);
    }
    if (lock_ < 0 || failed) {
        throw InputError("cannot write into the folder " + folder_.string() + ": " +
                         (failed ? failed.message() : std::generic_category().message(errno)));
    }
    refuse_existing();  // another run may have written there meanwhile
}

fs::path ResultFolder::stage(const std::string& name) {
    if (lock_ < 0) {
        begin();
    }
    names_.push_back(name);
    return staging_ / name;
}

void ResultFolder::write(const std::string& name, const std::string& text) {
    const fs::path path = stage(name);
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) {
        throw std::runtime_error("cannot write " + (folder_ / name).string());
    }
}

void ResultFolder::keep(const std::string& name, const std::string& text) {
    if (lock_ < 0) {
        begin();
    }
    io::write_file((folder_ / name).string(), text, true);
}

void ResultFolder::publish() {
    std::stable_partition(names_.begin(), names_.end(), [&](const std::string& name) { return name != key_file_; });
    fs::remove(folder_ / key_file_);
    for (const std::string& name : withdrawn_) {
        fs::remove(folder_ / name);
    }
    for (const std::string& name : names_) {
        fs::rename(staging_ / name, folder_ / name);
    }
    names_.clear();
}

}  // namespace coagula::report
