// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine_process.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/standard_descriptors.hpp>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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

[[noreturn]] void fail_missing(const Engine& engine, const std::string& program) {
    throw InputError("there is no program " + program + ", but " + engine.name + " is to do the work: install it (" +
                     engine.source + ") or name it in the engine command");
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

/// Starts the program in a process group of its own, so that Ctrl-C reaches coagula alone, which then ends it.
pid_t spawn(const Engine& engine, std::vector<std::string> words, int input, const std::string& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (input == no_input) {
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    } else {
        posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    }
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
        fail_missing(engine, words.front());
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

void check_installed(const Engine& engine) {
    const std::string& program = engine.command.front();
    if (program.find('/') != std::string::npos) {
        if (!is_program(program)) {
            fail_missing(engine, program);
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
    fail_missing(engine, program);
}

EngineProcess::EngineProcess(const Engine& engine, const std::vector<std::string>& arguments, int input,
                             std::filesystem::path output)
    : name_(engine.name), output_(std::move(output)) {
    io::occupy_standard_descriptors();
    std::vector<std::string> words = engine.command;
    words.insert(words.end(), arguments.begin(), arguments.end());
    process_ = spawn(engine, std::move(words), input, output_.string());
}

EngineProcess::~EngineProcess() {
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

bool EngineProcess::ended() {
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

void EngineProcess::pause(const std::function<void()>& meanwhile) {
    if (meanwhile) {
        meanwhile();
    }
    std::this_thread::sleep_for(between_looks);
}

void EngineProcess::finish(const std::function<void()>& meanwhile, const std::filesystem::path& log) {
    while (!ended()) {
        pause(meanwhile);
    }
    if (failed_) {
        fail(log);
    }
}

void EngineProcess::fail(const std::filesystem::path& log) const {
    std::string reason = log.empty() ? "" : last_error(log.string());
    if (reason.empty()) {
        reason = last_error(output_.string());
    }
    if (reason.empty()) {
        reason = first_words(output_.string());
    }
    throw std::runtime_error(name_ + " failed: " + (reason.empty() ? "it ended and said nothing" : reason));
}

}  // namespace coagula::stages
