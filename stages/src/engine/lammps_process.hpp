// SPDX-License-Identifier: GPL-3.0-or-later
// LAMMPS as a process that takes its commands one after the other.
#pragma once

#include "engine_process.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace coagula::stages {

/// A path as a word of a command.
std::string quoted(const std::filesystem::path& path);

/// A file that LAMMPS reads. Throws std::runtime_error where it cannot be written.
void write_for_lammps(const std::filesystem::path& path, const std::string& text);

/// One run of LAMMPS. The end of this object ends the process.
class LammpsProcess {
public:
    /// @param folder for its log and what it prints. Throws InputError where there is no such program.
    LammpsProcess(const Engine& engine, std::filesystem::path folder);
    LammpsProcess(const LammpsProcess&) = delete;
    LammpsProcess& operator=(const LammpsProcess&) = delete;
    ~LammpsProcess();

    /// Lines of commands.
    void send(const std::string& lines) const;
    /// Waits until the file is there, which LAMMPS makes at once by a rename, and calls `meanwhile` now and then. Throws
    /// std::runtime_error with the last error of LAMMPS when it ends without it.
    void wait_for(const std::filesystem::path& file, const std::function<void()>& meanwhile);
    /// Waits until LAMMPS has done all commands and ended. Throws as wait_for does when it fails.
    void finish(const std::function<void()>& meanwhile);
    /// The version that the log of a finished run names, such as "29 Sep 2021 - Update 2".
    std::string version() const;

private:
    std::filesystem::path folder_;
    int commands_ = -1;  ///< descriptor of its standard input
    std::optional<EngineProcess> process_;
};

}  // namespace coagula::stages
