// SPDX-License-Identifier: GPL-3.0-or-later
// Files that several processes write, or whose writers were killed.
#include <coagula/io/atomic_file.hpp>
#include <coagula/io/structure_file.hpp>
#include <coagula/io/unfinished_file.hpp>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <thread>

#include "example_packing.hpp"
#include "temporary_file.hpp"
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
    add_results(path, path, {{}, std::nullopt, {}, {scalar("/mechanics/" + name, 1, "1", "a result")}, stage(name)}, false);
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
    EXPECT_EQ(sentence<std::runtime_error>([&] {
                  add_results(file("a.h5"), file("a.h5"), {{}, std::nullopt, {}, {}, provenance}, false);
              }),
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
    write(".a.h5.lock", "");
    write(".a.h5.0123456789ab.tmp", "half a file");
    std::filesystem::create_hard_link(file(".a.h5.0123456789ab.tmp"), file("precious"));
    write(".a.h5.my-own-copy.tmp", "kept");
    write(".b.h5.0123456789ab.tmp", "of another file");
    add(file("a.h5"), "x");
    EXPECT_EQ(read(file("precious")), "half a file") << "what lies under the hidden name is not written to";
    EXPECT_FALSE(std::filesystem::exists(file(".a.h5.0123456789ab.tmp")));
    EXPECT_FALSE(std::filesystem::exists(file(".a.h5.lock")));
    EXPECT_EQ(entries().size(), 4U);
}

TEST_F(OutputFiles, AHiddenNameThatLeadsElsewhereIsNotFollowed) {
    const std::string other = write("other", "precious");
    std::filesystem::create_symlink(other, file(".a.h5.lock"));
    EXPECT_THROW(write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false), InputError);
    EXPECT_EQ(read(other), "precious");
}

TEST_F(OutputFiles, WhatIsNotCompleteCanBeRemovedAtAnyTime) {
    const OutputPlace place(file("a"));
    {
        const OutputFile locked(file("b"), false);
        const TemporaryFile one(place);
        const TemporaryFile other(place);
        EXPECT_EQ(entries().size(), 3U);
        remove_unfinished_files();
        EXPECT_EQ(entries().size(), 0U);
    }
    write_file(file("a"), std::string("whole"), false);
    remove_unfinished_files();
    EXPECT_EQ(read(file("a")), "whole");
    EXPECT_EQ(entries().size(), 1U);
}

TEST_F(OutputFiles, WaitsForTheWriterBefore) {
    write_structure(file("a.h5"), example(), {}, {}, stage("generate"), false);
    const int held = open(file(".a.h5.lock").c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
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

TEST_F(OutputFiles, LinksLeadToTheFileThatIsWritten) {
    std::filesystem::create_directory(file("elsewhere"));
    const std::string target = write("elsewhere/target", "old");
    std::filesystem::create_symlink("elsewhere/target", file("link"));
    std::filesystem::create_symlink(file("link"), file("link_to_link"));
    std::filesystem::create_symlink("elsewhere/none_yet", file("dangling"));
    write_file(file("link"), std::string("one"), true);
    EXPECT_EQ(read(target), "one");
    write_file(file("link_to_link"), std::string("two"), true);
    EXPECT_EQ(read(target), "two");
    write_file(file("dangling"), std::string("three"), false);
    EXPECT_EQ(read(file("elsewhere/none_yet")), "three");
    for (const char* name : {"link", "link_to_link", "dangling"}) {
        EXPECT_TRUE(std::filesystem::is_symlink(file(name))) << name;
    }
    std::filesystem::create_symlink("round", file("round"));
    EXPECT_NE(sentence<InputError>([&] { write_file(file("round"), std::string("x"), true); }).find("symbolic links"),
              std::string::npos);
}

/// In a folder where others may write.
TEST_F(OutputFiles, ALinkOfAnotherUserIsNotFollowed) {
    if (geteuid() != 0) {
        GTEST_SKIP() << "only root may give links away";
    }
    const std::string target = write("target", "precious");
    std::filesystem::create_directory(file("shared"));
    const std::string link = file("shared/link");
    std::filesystem::create_symlink(target, link);
    std::filesystem::create_symlink(link, file("over"));
    ASSERT_EQ(lchown(link.c_str(), 1234, 1234), 0);
    for (const mode_t mode : {01777U, 0777U, 0775U}) {
        ASSERT_EQ(chmod(file("shared").c_str(), mode), 0);
        for (const std::string& name : {link, file("over")}) {
            EXPECT_NE(sentence<InputError>([&] { write_file(name, std::string("x"), true); }).find("another user"),
                      std::string::npos);
            EXPECT_THROW(check_output(name, true), InputError);
        }
    }
    EXPECT_EQ(read(target), "precious");
    ASSERT_EQ(chmod(file("shared").c_str(), 0755), 0);
    write_file(link, std::string("mine"), true);
    EXPECT_EQ(read(target), "mine");
    ASSERT_EQ(chmod(file("shared").c_str(), 01777), 0);
    ASSERT_EQ(lchown(link.c_str(), geteuid(), getegid()), 0);
    write_file(link, std::string("my own link"), true);
    EXPECT_EQ(read(target), "my own link");
}

TEST_F(OutputFiles, AProtectedFileIsNotReplaced) {
    const std::string path = write("kept.csv", "precious");
    for (const mode_t mode : {0444U, 0400U, 0555U}) {
        ASSERT_EQ(chmod(path.c_str(), mode), 0);
        EXPECT_NE(sentence<InputError>([&] { check_output(path, true); }).find("protected against writing"), std::string::npos);
        EXPECT_THROW(write_file(path, std::string("x"), true), InputError);
        EXPECT_EQ(read(path), "precious");
    }
    EXPECT_NE(sentence<InputError>([&] { check_output(path, false); }).find("exists already"), std::string::npos);
}

TEST_F(OutputFiles, AFolderInWhichNothingCanBeMadeIsRefusedAtOnce) {
    const std::string gone = file("gone");
    std::filesystem::create_directory(gone);
    const auto write_in_removed_folder = [&] {
        std::filesystem::current_path(gone);
        std::filesystem::remove(gone);
        write_file("x.h5", std::string("x"), false);
    };
    EXPECT_EQ(at_once({write_in_removed_folder, [] { check_output("/proc/x.h5", true); },
                       [] { write_file("/proc/x.h5", std::string("x"), false); }, [] { check_output("/sys/x.h5", true); }}),
              std::vector<int>(4, 2));
}

TEST_F(OutputFiles, WhatIsReadBackMustBeWhatWasWritten) {
    const OutputPlace place(file("a"));
    for (const std::string written : {"", "precios", "preciousss", "Precious"}) {
        TemporaryFile temporary(place);
        temporary.write(written);
        EXPECT_THROW(temporary.sync(std::string("precious")), std::runtime_error) << written;
    }
    EXPECT_TRUE(entries().empty());
    TemporaryFile temporary(place);
    temporary.write(std::string("precious"));
    EXPECT_NO_THROW(temporary.sync(std::string("precious")));
}

TEST_F(OutputFiles, AFolderIsMadeWithThoseAboveIt) {
    EXPECT_TRUE(make_folder(file("a/b/c/")));
    EXPECT_TRUE(std::filesystem::is_directory(file("a/b/c")));
    EXPECT_FALSE(make_folder(file("a/b")));
}

}  // namespace
}  // namespace coagula::io
