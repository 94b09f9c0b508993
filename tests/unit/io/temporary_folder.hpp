// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of its own for each test, gone afterwards.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace coagula::io {

class TemporaryFolder : public ::testing::Test {
public:
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() override { std::filesystem::remove_all(folder_); }

protected:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "coagula_io_XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
    }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& contents) const {
        std::ofstream(file(name), std::ios::binary) << contents;
        return file(name);
    }

    static std::string read(const std::string& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// Names of all entries, hidden ones too.
    std::vector<std::string> entries() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
            names.push_back(entry.path().filename().string());
        }
        return names;
    }

    std::filesystem::path folder_;
};

/// The sentence of the exception of type Error that `work` throws.
template <class Error, class Work>
std::string sentence(Work&& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
}

}  // namespace coagula::io
