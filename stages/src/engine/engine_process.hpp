// SPDX-License-Identifier: GPL-3.0-or-later
// Another program at work.
#pragma once

#include <coagula/stages/engine.hpp>

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace coagula::stages {

/// Throws InputError, naming where to get it, where the first word of the command is no program.
void check_installed(const Engine& engine);

constexpr int no_input = -1;  ///< instead of a descriptor

/// One run of the program. The end of this object ends it.
class EngineProcess {
public:
    /// @param arguments after the words of the command. @param input descriptor, or no_input. @param output file for what it
    /// prints. Throws InputError where there is no such program.
    EngineProcess(const Engine& engine, const std::vector<std::string>& arguments, int input, std::filesystem::path output);
    EngineProcess(const EngineProcess&) = delete;
    EngineProcess& operator=(const EngineProcess&) = delete;
    ~EngineProcess();

    bool ended();
    /// Calls `meanwhile` and lets a moment pass.
    static void pause(const std::function<void()>& meanwhile);
    /// Waits until it has ended, and calls `meanwhile` now and then. Throws as fail() when it fails.
    void finish(const std::function<void()>& meanwhile, const std::filesystem::path& log = {});
    /// Throws std::runtime_error with the last error that it wrote. @param log that it writes besides; empty: none.
    [[noreturn]] void fail(const std::filesystem::path& log = {}) const;

private:
    std::string name_;
    std::filesystem::path output_;
    pid_t process_ = 0;  ///< 0: it has ended
    bool failed_ = false;
};

}  // namespace coagula::stages
