#include "output_file.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/structure_file.hpp>

#include <unistd.h>

#include <filesystem>

namespace coagula::tools {

namespace {

namespace fs = std::filesystem;

/// A file is first written as .NAME.tmp beside its place: NAME_MAX bytes in all.
constexpr std::size_t longest_name = 255 - 5;

/// Files are replaced by a rename, so what must be writable is the folder.
void check_folder(const std::string& path) {
    const std::string name = fs::path(path).filename().string();
    if (name.size() > longest_name) {
        throw InputError("cannot write " + path + ": the name has " + std::to_string(name.size()) + " bytes, and " +
                         std::to_string(longest_name) + " are possible");
    }
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder)) {
        throw InputError("cannot write " + path + ": there is no folder " + folder);
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw InputError("cannot write " + path + ": no permission to write in the folder " + folder);
    }
}

}  // namespace

void check_output(const std::string& path, bool force) {
    io::check_output(path, force);
    check_folder(path);
}

void check_updatable(const std::string& path) {
    io::check_source(path);
    check_folder(path);
}

std::string checked_target(const Arguments& arguments) {
    if (!arguments.has("output")) {
        check_updatable(arguments.input());
        return arguments.input();
    }
    io::check_source(arguments.input());
    check_output(arguments.text("output"), arguments.flag("force"));
    return arguments.text("output");
}

}  // namespace coagula::tools
