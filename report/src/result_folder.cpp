// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/result_folder.hpp>

#include <coagula/common/failures.hpp>
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/input_file.hpp>

#include <sys/stat.h>
#include <unistd.h>

#include <sstream>
#include <utility>

namespace coagula::report {

namespace fs = std::filesystem;

namespace {

/// Among the files that are whole: names to be removed, one on each line.
constexpr const char* withdrawn_list = ".withdrawn";

/// Anybody could put files here into a folder where others may write.
void require_own(const fs::path& folder) {
    struct stat found {};
    if (lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != geteuid()) {
        throw InputError(folder.string() + " belongs to a run of another user, which did not come to its end; remove it");
    }
}

std::vector<std::string> visible_names(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    std::erase_if(names, [](const std::string& name) { return name.starts_with('.'); });
    return names;
}

}  // namespace

ResultFolder::ResultFolder(fs::path folder, std::string key_file, std::vector<std::string> others, bool force)
    : folder_(std::move(folder)),
      key_file_(std::move(key_file)),
      others_(std::move(others)),
      force_(force),
      staging_(folder_ / ".new"),
      whole_(folder_ / ".whole") {
    if (fs::exists(folder_) && !fs::is_directory(folder_)) {
        throw InputError(folder_.string() + " exists already and is not a folder");
    }
    if (fs::is_directory(whole_)) {
        lock();
        put_in_place();
        lock_.reset();
    }
    refuse_existing();
}

ResultFolder::~ResultFolder() {
    if (lock_) {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
        lock_.reset();
        if (made_) {
            fs::remove(folder_, ignored);  // only if empty
        }
    }
}

std::vector<fs::path> ResultFolder::files() const {
    std::vector<fs::path> paths{folder_ / key_file_};
    for (const std::string& name : others_) {
        paths.push_back(folder_ / name);
    }
    return paths;
}

void ResultFolder::refuse_existing() const {
    for (const fs::path& path : files()) {
        if (fs::is_directory(path)) {
            throw InputError(path.string() + " is a folder, but a file of this name is to be written");
        }
        if (fs::exists(path) && !force_) {
            throw ExistsAlready(path.string() + " is there already; use --force to replace it");
        }
    }
}

void ResultFolder::lock() {
    key_place_.emplace((folder_ / key_file_).string());
    lock_.emplace(*key_place_, "run");
    lock_->take();
}

/// Makes and locks the folder.
void ResultFolder::begin() {
    try {
        made_ = io::make_folder(folder_);
        lock();
        put_in_place();  // of another run that was killed meanwhile
        fs::remove_all(staging_);
        fs::create_directory(staging_);
    } catch (const fs::filesystem_error& error) {
        throw InputError("cannot write into the folder " + folder_.string() + ": " + error.code().message());
    }
    refuse_existing();  // another run may have written there meanwhile
}

fs::path ResultFolder::stage(const std::string& name) {
    if (!lock_) {
        begin();
    }
    return staging_ / name;
}

void ResultFolder::write(const std::string& name, const std::string& text) {
    io::write_file(stage(name).string(), text, true);
}

void ResultFolder::keep(const std::string& name, const std::string& text) {
    if (!lock_) {
        begin();
    }
    io::write_file((folder_ / name).string(), text, true);
}

void ResultFolder::publish() {
    std::string names;
    for (const std::string& name : withdrawn_) {
        names += name + "\n";
    }
    write(withdrawn_list, names);
    fs::rename(staging_, whole_);
    io::sync_folder(folder_);
    put_in_place();
}

/// Nothing where nothing is whole. What a killed run had in place before, its key file aside, is no longer among the files.
void ResultFolder::put_in_place() const {
    if (!fs::exists(whole_)) {
        return;
    }
    require_own(whole_);
    if (fs::exists(whole_ / key_file_)) {
        io::remove_file((folder_ / key_file_).string());
        std::istringstream withdrawn(io::read_file((whole_ / withdrawn_list).string()));
        for (std::string name; std::getline(withdrawn, name);) {
            io::remove_file((folder_ / fs::path(name).filename()).string());
        }
        for (const std::string& name : visible_names(whole_)) {
            if (name != key_file_) {
                move(name);
            }
        }
        move(key_file_);
    }
    fs::remove_all(whole_);
}

void ResultFolder::move(const std::string& name) const {
    io::write_file((folder_ / name).string(), io::read_file((whole_ / name).string()), true);
    fs::remove(whole_ / name);
}

}  // namespace coagula::report
