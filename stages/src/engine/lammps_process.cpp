// SPDX-License-Identifier: GPL-3.0-or-later
#include "lammps_process.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/standard_descriptors.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

namespace coagula::stages {

namespace {

constexpr auto between_looks = std::chrono::milliseconds(2);
constexpr int looks_before_kill = 1000;

[[noreturn]] void fail_missing(const std::string& program) {
    throw InputError("there is no program " + program +
                     ", but LAMMPS is to do the work: install it (Debian: apt-get install lammps) " +
                     "or name it in the engine command");
}

std::string log_of(const std::filesystem::path& folder) {
    return (folder / "log.lammps").string();
}

std::string output_of(const std::filesystem::path& folder) {
    return (folder / "output.txt").string();
}

/// The last line about an error; empty: none.
std::string last_error(const std::string& path) {
    std::ifstream file(path);
    std::string last;
    for (std::string line; std::getline(file, line);) {
        if (line.find("ERROR") != std::string::npos) {
            last = line;
        }
    }
    return last;
}

/// The first line with a letter, which says most where mpirun complains; empty: none.
std::string first_words(const std::string& path) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (std::any_of(line.begin(), line.end(), [](unsigned char letter) { return std::isalpha(letter) != 0; })) {
            return line;
        }
    }
    return "";
}

/// In a process group of its own: Ctrl-C reaches coagula alone, which then ends it.
pid_t spawn(std::vector<std::string> words, int input, const std::string& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int failed = posix_spawnp(&child, words.front().c_str(), &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed == ENOENT) {
        fail_missing(words.front());
    }
    if (failed != 0) {
        throw InputError(words.front() + " cannot be started: " + std::generic_category().message(failed));
    }
    return child;
}

bool is_program(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

}  // namespace

std::string quoted(const std::filesystem::path& path) {
    return '"' + path.string() + '"';
}

void write_for_lammps(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path);
    file << text << std::flush;
    if (!file) {
        throw std::runtime_error("cannot write " + path.string() + ", which LAMMPS is to read");
    }
}

void check_installed(const std::vector<std::string>& command) {
    const std::string& program = command.front();
    if (program.find('/') != std::string::npos) {
        if (!is_program(program)) {
            fail_missing(program);
        }
        return;
    }
    const char* path = std::getenv("PATH");
    std::string_view rest = path != nullptr ? path : "/bin:/usr/bin";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(':'), rest.size());
        if (is_program(std::filesystem::path(rest.substr(0, end)) / program)) {
            return;
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    fail_missing(program);
}

LammpsProcess::LammpsProcess(const std::vector<std::string>& command, std::filesystem::path folder) : folder_(std::move(folder)) {
    io::occupy_standard_descriptors();
    std::array<int, 2> ends{};
    // Not a pipe: writing to a LAMMPS that has ended must not end coagula by a signal.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw std::runtime_error("no channel to LAMMPS can be opened: " + std::generic_category().message(errno));
    }
    commands_ = ends[0];
    std::vector<std::string> words = command;
    words.insert(words.end(), {"-log", log_of(folder_), "-screen", "none", "-nocite"});
    try {
        process_ = spawn(std::move(words), ends[1], output_of(folder_));
    } catch (...) {
        close(ends[1]);
        close(commands_);
        throw;
    }
    close(ends[1]);
}

LammpsProcess::~LammpsProcess() {
    close(commands_);
    if (ended()) {
        return;
    }
    kill(-process_, SIGTERM);
    for (int look = 0; look < looks_before_kill && !ended(); ++look) {
        std::this_thread::sleep_for(between_looks);
    }
    if (process_ != 0) {
        kill(-process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
}

void LammpsProcess::send(const std::string& lines) const {
    for (std::size_t done = 0; done < lines.size();) {
        const ssize_t count = ::send(commands_, lines.data() + done, lines.size() - done, MSG_NOSIGNAL);
        if (count < 0 && errno != EINTR) {
            return;  // it has ended; whoever waits for it learns why
        }
        done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
}

bool LammpsProcess::ended() {
    if (process_ == 0) {
        return true;
    }
    int status = 0;
    const pid_t changed = waitpid(process_, &status, WNOHANG);
    if (changed == 0 || (changed < 0 && errno == EINTR)) {
        return false;
    }
    // Where SIGCHLD is ignored nobody knows the status: what it has written tells.
    failed_ = changed > 0 && !(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    process_ = 0;
    return true;
}

void LammpsProcess::pause(const std::function<void()>& meanwhile) {
    if (meanwhile) {
        meanwhile();
    }
    std::this_thread::sleep_for(between_looks);
}

void LammpsProcess::wait_for(const std::filesystem::path& file, const std::function<void()>& meanwhile) {
    std::error_code ignored;
    while (!std::filesystem::exists(file, ignored)) {
        if (ended() && !std::filesystem::exists(file, ignored)) {
            fail();
        }
        pause(meanwhile);
    }
}

void LammpsProcess::finish(const std::function<void()>& meanwhile) {
    shutdown(commands_, SHUT_WR);
    while (!ended()) {
        pause(meanwhile);
    }
    if (failed_) {
        fail();
    }
}

void LammpsProcess::fail() const {
    std::string reason = last_error(log_of(folder_));
    if (reason.empty()) {
        reason = last_error(output_of(folder_));
    }
    if (reason.empty()) {
        reason = first_words(output_of(folder_));
    }
    throw std::runtime_error("LAMMPS failed: " + (reason.empty() ? "it ended and said nothing" : reason));
}

std::string LammpsProcess::version() const {
    std::ifstream log(log_of(folder_));
    std::string line;
    std::getline(log, line);
    const std::size_t begin = line.find('(');
    const std::size_t end = line.rfind(')');
    return begin == std::string::npos || end == std::string::npos || end < begin ? "of unknown version"
                                                                                 : line.substr(begin + 1, end - begin - 1);
}

}  // namespace coagula::stages
