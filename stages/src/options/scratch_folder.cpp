// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/stages/scratch_folder.hpp>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace coagula::stages {

ScratchFolder::ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "coagula-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) {
        throw std::runtime_error("no folder for temporary files can be made as " + name + ": " +
                                 std::generic_category().message(errno));
    }
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace coagula::stages
