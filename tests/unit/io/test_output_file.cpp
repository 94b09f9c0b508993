// Files that several processes write, or whose writers were killed.
#include <coagula/io/structure_file.hpp>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "example_packing.hpp"
#include "temporary_folder.hpp"

namespace coagula::io {
namespace {

using OutputFiles = TemporaryFolder;

const Structure& example() {
    static const Structure structure{example_packing(30, true), std::nullopt};
    return structure;
}

Provenance stage(const std::string& name) {
    Provenance entry;
    entry.stage = name;
    return entry;
}

void add(const std::string& path, const std::string& name) {
    add_results(path, path, {}, std::nullopt, {}, {scalar("/mechanics/" + name, 1, "1", "a result")}, stage(name), false);
}

/// Runs `work` in processes of their own, all at once; their exit codes. No work may start threads, which a forked process cannot.
std::vector<int> at_once(const std::vector<std::function<void()>>& works) {
    std::vector<pid_t> children;
    for (const auto& work : works) {
        children.push_back(fork());
        if (children.back() == 0) {
            try {
                work();
                _exit(0);
            } catch (const InputError&) {
                _exit(2);
            } catch (...) {
                _exit(1);
            }
        }
    }
    std::vector<int> codes;
    for (const pid_t child : children) {
        int status = 0;
        waitpid(child, &status, 0);
        codes.push_back(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    }
    return codes;
}

TEST_F(OutputFiles, ResultsOfAllWritersAreKept) {
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    std::vector<std::function<void()>> works;
    for (int writer = 0; writer < 4; ++writer) {
        works.emplace_back([this, writer] {
            for (int turn = 0; turn < 5; ++turn) {
                add(file("a.h5"), "result_" + std::to_string(10 * writer + turn));
            }
        });
    }
    EXPECT_EQ(at_once(works), std::vector<int>(4, 0));
    EXPECT_EQ(read_results(file("a.h5"), "/mechanics").size(), 20U);
    EXPECT_EQ(read_provenance(file("a.h5")).size(), 21U);
    EXPECT_EQ(entries(), std::vector<std::string>{"a.h5"});
}

TEST_F(OutputFiles, OneOfSeveralMakesANewFile) {
    for (int turn = 0; turn < 5; ++turn) {
        const std::string path = file("new.h5");
        const std::vector<std::function<void()>> works(6, [&] { write_datasets(path, {scalar("/x", 1, "1", "a number")}, false); });
        std::vector<int> codes = at_once(works);
        std::sort(codes.begin(), codes.end());
        EXPECT_EQ(codes, (std::vector<int>{0, 2, 2, 2, 2, 2}));
        EXPECT_EQ(entries(), std::vector<std::string>{"new.h5"});
        std::filesystem::remove(path);
    }
}

TEST_F(OutputFiles, ResultsOfAPackingThatWasReplacedAreRefused) {
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    const std::string before = read(file("a.h5"));
    const std::string other = positions_sha256(example_packing(31, true));
    Provenance provenance = stage("shear");
    provenance.positions_sha256 = other;
    EXPECT_EQ(
        sentence<std::runtime_error>([&] { add_results(file("a.h5"), file("a.h5"), {}, std::nullopt, {}, {}, provenance, false); }),
        file("a.h5") + " holds another packing than when this run began; its results are not written");
    EXPECT_EQ(read(file("a.h5")), before);
}

mode_t mode_of(const std::string& path) {
    struct stat found {};
    EXPECT_EQ(stat(path.c_str(), &found), 0);
    return found.st_mode & 07777;
}

TEST_F(OutputFiles, AReplacedFileKeepsItsMode) {
    const mode_t mask = umask(022);
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    EXPECT_EQ(mode_of(file("a.h5")), 0644U);
    for (const mode_t mode : {0600U, 0640U, 0664U}) {
        chmod(file("a.h5").c_str(), mode);
        add(file("a.h5"), "x");
        EXPECT_EQ(mode_of(file("a.h5")), mode);
        write_structure(file("a.h5"), example(), {}, {}, stage("generate"), true);
        EXPECT_EQ(mode_of(file("a.h5")), mode);
    }
    umask(mask);
}

TEST_F(OutputFiles, AReplacedFileKeepsItsOwner) {
    if (geteuid() != 0) {
        GTEST_SKIP() << "only root may give files away";
    }
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    ASSERT_EQ(chown(file("a.h5").c_str(), 1234, 4321), 0);
    add(file("a.h5"), "x");
    struct stat found {};
    stat(file("a.h5").c_str(), &found);
    EXPECT_EQ(found.st_uid, 1234U);
    EXPECT_EQ(found.st_gid, 4321U);
}

TEST_F(OutputFiles, WhatAKilledRunLeftIsRemoved) {
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    write(".a.h5.tmp", "half a file");
    std::filesystem::create_hard_link(file(".a.h5.tmp"), file("precious"));
    add(file("a.h5"), "x");
    EXPECT_EQ(read(file("precious")), "half a file") << "what lies under the hidden name is not written to";
    EXPECT_FALSE(std::filesystem::exists(file(".a.h5.tmp")));
    EXPECT_EQ(entries().size(), 2U);
}

TEST_F(OutputFiles, AHiddenNameThatLeadsElsewhereIsNotFollowed) {
    const std::string other = write("other", "precious");
    std::filesystem::create_symlink(other, file(".a.h5.tmp"));
    EXPECT_THROW(write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false), std::runtime_error);
    EXPECT_EQ(read(other), "precious");
}

TEST_F(OutputFiles, WaitsForTheWriterBefore) {
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    const int held = open(file(".a.h5.tmp").c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
    struct flock whole {};
    whole.l_type = F_WRLCK;
    ASSERT_EQ(fcntl(held, F_OFD_SETLK, &whole), 0);
    std::thread writer([&] { add(file("a.h5"), "x"); });
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_TRUE(read_results(file("a.h5"), "/mechanics").empty()) << "it did not wait";
    close(held);
    writer.join();
    EXPECT_EQ(read_results(file("a.h5"), "/mechanics").size(), 1U);
}

}  // namespace
}  // namespace coagula::io
