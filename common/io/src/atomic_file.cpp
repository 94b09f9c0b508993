// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/atomic_file.hpp>

#include <coagula/common/failures.hpp>
#include <coagula/io/structure_file.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "temporary_file.hpp"

namespace coagula::io {

void check_output(const std::string& path, bool overwrite) {
    const OutputPlace place(path);
    place.check(overwrite);
    const TemporaryFile probe(place);  // no question tells as surely whether a file can be made there
}

OutputFile::OutputFile(const std::string& path, bool overwrite) : place_(path), lock_(place_, "lock"), overwrite_(overwrite) {
    place_.check(overwrite_);
    lock_.take();
    place_.check(overwrite_);  // another process may have written it meanwhile
    if (lock_.was_left()) {
        TemporaryFile::remove_leftovers(place_);
    }
}

OutputFile::~OutputFile() = default;

void OutputFile::publish(std::span<const char> bytes) {
    TemporaryFile file(place_);
    file.write(bytes);
    file.keep_owner_and_mode();
    file.sync(bytes);
    publish(file);
}

int OutputFile::open_in_place() {
    in_place_ = std::make_unique<TemporaryFile>(place_);
    return in_place_->descriptor();
}

void OutputFile::publish_in_place(std::size_t size) {
    in_place_->keep_owner_and_mode();
    in_place_->finish(size);
    publish(*in_place_);
    in_place_.reset();
}

void OutputFile::publish(TemporaryFile& file) {
    file.rename(overwrite_);
    place_.sync();
}

void write_file(const std::string& path, std::span<const char> bytes, bool overwrite) {
    OutputFile(path, overwrite).publish(bytes);
}

void remove_file(const std::string& path) {
    const OutputPlace place(path);
    if (unlinkat(place.folder(), place.name().c_str(), 0) != 0 && errno != ENOENT) {
        place.fail();
    }
}

void sync_folder(const std::filesystem::path& path) {
    OutputPlace((path / "entry").string()).sync();
}

bool make_folder(const std::filesystem::path& path) {
    if (path.empty() || std::filesystem::is_directory(path)) {
        return false;
    }
    if (!path.has_filename()) {
        return make_folder(path.parent_path());  // of a name with a slash at the end
    }
    make_folder(path.parent_path());
    const bool made = std::filesystem::create_directory(path);
    sync_folder(path.has_parent_path() ? path.parent_path() : std::filesystem::path("."));
    return made;
}

}  // namespace coagula::io
