#include "result_folder.hpp"

#include <coagula/common/checks.hpp>

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace coagula::tools {

namespace fs = std::filesystem;

ResultFolder::ResultFolder(fs::path folder, std::string key_file, const std::vector<std::string>& others, bool force)
    : folder_(std::move(folder)), key_file_(std::move(key_file)), staging_(folder_ / (".new." + std::to_string(getpid()))) {
    if (fs::exists(folder_) && !fs::is_directory(folder_)) {
        throw InputError(folder_.string() + " is there already and is no folder");
    }
    std::vector<std::string> names{key_file_};
    names.insert(names.end(), others.begin(), others.end());
    for (const std::string& name : names) {
        const fs::path path = folder_ / name;
        if (fs::is_directory(path)) {
            throw InputError(path.string() + " is a folder, but a file of this name is to be written");
        }
        if (fs::exists(path) && !force) {
            throw InputError(path.string() + " is there already; use --force to replace it");
        }
    }
}

ResultFolder::~ResultFolder() {
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
    if (made_) {
        fs::remove(folder_, ignored);  // only if empty
    }
}

fs::path ResultFolder::stage(const std::string& name) {
    std::error_code failed;
    made_ = fs::create_directories(folder_, failed) || made_;
    if (!failed) {
        fs::create_directory(staging_, failed);
    }
    if (failed) {
        throw InputError("cannot write into the folder " + folder_.string() + ": " + failed.message());
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

}  // namespace coagula::tools
