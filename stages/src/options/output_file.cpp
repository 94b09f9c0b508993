// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/checks.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/stages/output_file.hpp>

#include <algorithm>
#include <filesystem>

namespace coagula::stages {

namespace {

namespace fs = std::filesystem;

bool is_same_file(const std::string& one, const std::string& other) {
    std::error_code missing;
    return fs::equivalent(one, other, missing);
}

/// Whether two paths name one file, which need not be there yet.
bool is_same_place(const std::string& one, const std::string& other) {
    std::error_code missing;
    return is_same_file(one, other) || fs::weakly_canonical(one, missing) == fs::weakly_canonical(other, missing);
}

void refuse_read(const std::string& path, const std::vector<std::string>& read) {
    const auto same = std::find_if(read.begin(), read.end(), [&](const std::string& file) { return is_same_file(file, path); });
    if (same != read.end()) {
        throw InputError("cannot write " + path + ": this call reads " + (*same == path ? "it" : "the same file as " + *same) +
                         ", and would destroy it; give the output another name");
    }
}

}  // namespace

void check_not_read(const Arguments& arguments, const std::string& path, const std::vector<std::string>& also_read) {
    std::vector<std::string> read = arguments.files(Option::File::read);
    read.insert(read.end(), also_read.begin(), also_read.end());
    refuse_read(path, read);
}

void check_not_read(const std::string& path, const std::string& input, const std::vector<std::string>& others) {
    refuse_read(path, {input});
    refuse_read(path, others);
}

void check_output(const Arguments& arguments, const std::string& path, const std::vector<std::string>& also_read) {
    check_not_read(arguments, path, also_read);
    const std::vector<std::string> written = arguments.files(Option::File::written);
    if (std::count_if(written.begin(), written.end(), [&](const std::string& file) { return is_same_place(file, path); }) > 1) {
        throw InputError("cannot write " + path + ": two outputs of this call have that name; give each a name of its own");
    }
    io::check_output(path, arguments.flag("force"));
}

void check_updatable(const std::string& path) {
    io::check_source(path);
    io::check_output(path, true);
}

std::string checked_target(const Arguments& arguments) {
    if (!arguments.has("output")) {
        check_updatable(arguments.input());
        return arguments.input();
    }
    check_output(arguments, arguments.text("output"));
    io::check_source(arguments.input());
    return arguments.text("output");
}

}  // namespace coagula::stages
