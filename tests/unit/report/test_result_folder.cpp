// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of results that are replaced as a whole.
#include <coagula/report/result_folder.hpp>

#include <coagula/common/checks.hpp>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace coagula::report {
namespace {

namespace fs = std::filesystem;

class ResultFolders : public ::testing::Test {
protected:
    ResultFolders() {
        std::string pattern = (fs::temp_directory_path() / "coagula_report_XXXXXX").string();
        root_ = mkdtemp(pattern.data());
        folder_ = root_ / "results";
        fs::create_directory(folder_);
        for (const auto& [name, text] : {std::pair{"key", "old"}, {"page", "old"}, {"model", "old"}, {"mine", "mine"}}) {
            write(folder_ / name, text);
        }
    }
    ResultFolders(const ResultFolders&) = delete;
    ResultFolders& operator=(const ResultFolders&) = delete;
    ~ResultFolders() override { fs::remove_all(root_); }

    static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
    static std::string read(const fs::path& path) {
        std::ifstream stream(path);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    ResultFolder open(bool force = true) const { return {folder_, "key", {"page", "model"}, force}; }
    void publish_new() const {
        ResultFolder results = open();
        results.write("key", "new");
        results.write("page", "new");
        results.withdraw("model");
        results.publish();
    }
    /// As a run leaves it that is killed when `placed` files are in place.
    void leave_whole(const std::vector<std::string>& placed) const {
        fs::create_directory(folder_ / ".whole");
        write(folder_ / ".whole/.withdrawn", "model\n");
        for (const std::string name : {"page", "key"}) {
            const bool done = std::find(placed.begin(), placed.end(), name) != placed.end();
            write(folder_ / (done ? name : ".whole/" + name), "new");
        }
        if (!placed.empty()) {
            fs::remove(folder_ / "model");
        }
    }
    void expect_new() const {
        EXPECT_EQ(read(folder_ / "key"), "new");
        EXPECT_EQ(read(folder_ / "page"), "new");
        EXPECT_EQ(read(folder_ / "mine"), "mine");
        EXPECT_FALSE(fs::exists(folder_ / "model"));
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3) << "something is left behind";
    }

    fs::path root_;
    fs::path folder_;
};

TEST_F(ResultFolders, OldFilesStayUntilTheNewOnesAreWhole) {
    {
        ResultFolder results = open();
        results.write("key", "new");
        results.write("page", "new");
        EXPECT_EQ(read(folder_ / "key"), "old");
        EXPECT_EQ(read(folder_ / "page"), "old");
    }
    EXPECT_EQ(read(folder_ / "key"), "old");
    EXPECT_FALSE(fs::exists(folder_ / ".new"));
    publish_new();
    expect_new();
}

TEST_F(ResultFolders, WhatAKilledRunHadWholeIsPutInPlace) {
    leave_whole({});
    open();
    expect_new();
}

TEST_F(ResultFolders, AKilledRunIsFinishedFromWhereItWas) {
    leave_whole({"page"});
    fs::remove(folder_ / "key");
    open();
    expect_new();
    leave_whole({"page", "key"});
    EXPECT_THROW(open(false), InputError) << "the new files are there already";
    expect_new();
}

TEST_F(ResultFolders, WithdrawnNamesStayInTheFolder) {
    write(root_ / "outside", "precious");
    leave_whole({});
    write(folder_ / ".whole/.withdrawn", "../outside\nmodel\n" + (root_ / "outside").string() + "\n");
    open();
    EXPECT_EQ(read(root_ / "outside"), "precious");
    expect_new();
}

TEST_F(ResultFolders, ModesAndLinksAreKept) {
    chmod((folder_ / "key").c_str(), 0600);
    fs::rename(folder_ / "page", root_ / "page");
    fs::create_symlink(root_ / "page", folder_ / "page");
    publish_new();
    expect_new();
    EXPECT_TRUE(fs::is_symlink(folder_ / "page"));
    EXPECT_EQ(read(root_ / "page"), "new");
}

TEST_F(ResultFolders, FilesOfAnotherUserAreNotPutInPlace) {
    if (geteuid() != 0) {
        GTEST_SKIP() << "only root may give folders away";
    }
    leave_whole({});
    ASSERT_EQ(chown((folder_ / ".whole").c_str(), 1234, 1234), 0);
    EXPECT_THROW(open(), InputError);
    EXPECT_EQ(read(folder_ / "key"), "old");
}

}  // namespace
}  // namespace coagula::report
