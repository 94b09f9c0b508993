// SPDX-License-Identifier: GPL-3.0-or-later
#include "lammps_process.hpp"

#include <coagula/io/standard_descriptors.hpp>

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace coagula::stages {

namespace {

std::filesystem::path log_of(const std::filesystem::path& folder) {
    return folder / "log.lammps";
}

/// Both ends of a channel for commands. Not a pipe: writing to a LAMMPS that has ended must not end coagula by a signal.
std::array<int, 2> channel() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw std::runtime_error("no channel to LAMMPS can be opened: " + std::generic_category().message(errno));
    }
    return ends;
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

LammpsProcess::LammpsProcess(const Engine& engine, std::filesystem::path folder) : folder_(std::move(folder)) {
    io::occupy_standard_descriptors();
    const std::array<int, 2> ends = channel();
    commands_ = ends[0];
    try {
        process_.emplace(engine, std::vector<std::string>{"-log", log_of(folder_).string(), "-screen", "none", "-nocite"}, ends[1],
                         folder_ / "output.txt");
    } catch (...) {
        close(ends[1]);
        close(commands_);
        throw;
    }
    close(ends[1]);
}

LammpsProcess::~LammpsProcess() {
    close(commands_);
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

void LammpsProcess::wait_for(const std::filesystem::path& file, const std::function<void()>& meanwhile) {
    std::error_code ignored;
    while (!std::filesystem::exists(file, ignored)) {
        if (process_->ended() && !std::filesystem::exists(file, ignored)) {
            process_->fail(log_of(folder_));
        }
        EngineProcess::pause(meanwhile);
    }
}

void LammpsProcess::finish(const std::function<void()>& meanwhile) {
    shutdown(commands_, SHUT_WR);
    process_->finish(meanwhile, log_of(folder_));
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
