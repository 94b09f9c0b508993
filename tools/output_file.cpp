#include "output_file.hpp"

#include <coagula/common/checks.hpp>

#include <unistd.h>

#include <filesystem>

namespace coagula::tools {

namespace {

namespace fs = std::filesystem;

/// Files are replaced by a rename, so what must be writable is the folder.
void check_folder(const std::string& path) {
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder)) {
        throw InputError(path + " cannot be written: there is no folder " + folder);
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError(path + " cannot be written: no permission to write in the folder " + folder);
    }
}

}  // namespace

void check_output(const std::string& path, bool force) {
    check_folder(path);
    if (fs::is_directory(path)) {
        throw InputError(path + " cannot be written: it is a folder");
    }
    if (fs::exists(path) && !force) {
        throw InputError(path + " already exists; give another name or --force to replace it");
    }
}

std::string checked_target(const Arguments& arguments) {
    if (!arguments.has("output")) {
        check_folder(arguments.input());
        return arguments.input();
    }
    check_output(arguments.text("output"), arguments.flag("force"));
    return arguments.text("output");
}

}  // namespace coagula::tools
