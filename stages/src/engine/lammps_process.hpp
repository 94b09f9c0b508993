// SPDX-License-Identifier: GPL-3.0-or-later
// LAMMPS as a process that takes its commands one after the other.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace coagula::stages {

/// A path as a word of a command.
std::string quoted(const std::filesystem::path& path);

/// A file that LAMMPS reads. Throws std::runtime_error where it cannot be written.
void write_for_lammps(const std::filesystem::path& path, const std::string& text);

/// Throws InputError, naming the Debian package, where the first word of the command is no program.
void check_installed(const std::vector<std::string>& command);

/// One run of LAMMPS. The end of this object ends the process.
class LammpsProcess {
public:
    /// @param command words, such as {"mpirun", "-n", "4", "lmp"}. @param folder for its log and what it prints.
    /// Throws InputError where there is no such program.
    LammpsProcess(const std::vector<std::string>& command, std::filesystem::path folder);
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
    bool ended();
    static void pause(const std::function<void()>& meanwhile);
    [[noreturn]] void fail() const;

    std::filesystem::path folder_;
    int commands_ = -1;  ///< descriptor of its standard input
    pid_t process_ = 0;  ///< 0: it has ended
    bool failed_ = false;
};

}  // namespace coagula::stages
