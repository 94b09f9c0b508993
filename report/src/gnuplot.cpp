// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/report/gnuplot.hpp>

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace coagula::report {

namespace {

/// A file without a name, in memory: what gnuplot reads and writes, so that neither side waits for the other.
class MemoryFile {
public:
    MemoryFile() : descriptor_(memfd_create("coagula", MFD_CLOEXEC)) {
        if (descriptor_ < 0) {
            throw std::runtime_error(std::string("no memory for a picture: ") + std::strerror(errno));
        }
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { close(descriptor_); }

    int descriptor() const { return descriptor_; }

    void fill(const std::string& text) const {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t count = write(descriptor_, text.data() + done, text.size() - done);
            if (count < 0) {
                throw std::runtime_error(std::string("no memory for a picture: ") + std::strerror(errno));
            }
            done += static_cast<std::size_t>(count);
        }
        lseek(descriptor_, 0, SEEK_SET);
    }

    std::string text() const {
        lseek(descriptor_, 0, SEEK_SET);
        std::string all;
        std::array<char, 65536> buffer{};
        for (ssize_t count = 0; (count = read(descriptor_, buffer.data(), buffer.size())) > 0;) {
            all.append(buffer.data(), static_cast<std::size_t>(count));
        }
        return all;
    }

private:
    int descriptor_;
};

/// The environment without what gnuplot would take for settings: a terminal, files that it reads at its start.
std::vector<char*> environment_of_gnuplot() {
    std::vector<char*> kept;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view variable = *entry;
        if (!variable.starts_with("GNU") && !variable.starts_with("FIT_")) {
            kept.push_back(*entry);
        }
    }
    kept.push_back(nullptr);
    return kept;
}

/// How gnuplot ended.
struct End {
    int not_started = 0;  ///< errno; 0: it ran
    int status = 0;       ///< its exit status
};

End spawn_gnuplot(const MemoryFile& commands, const MemoryFile& picture, const MemoryFile& complaints) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, commands.descriptor(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, picture.descriptor(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, complaints.descriptor(), STDERR_FILENO);
    std::array<std::string, 3> words{"gnuplot", "--default-settings", "-"};
    std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
    std::vector<char*> environment = environment_of_gnuplot();
    pid_t child = 0;
    const int failed = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) {
        return {.not_started = failed};
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) {
            return {};  // SIGCHLD is ignored in this process, and nobody knows the status: the picture tells
        }
    }
    return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : 1};
}

/// gnuplot repeats the command before it says what is wrong with it.
std::string last_line(std::string text) {
    text.erase(text.find_last_not_of(" \n") + 1);
    const std::size_t begin = text.rfind('\n');
    text.erase(0, begin == std::string::npos ? 0 : text.find_first_not_of(' ', begin + 1));
    return text;
}

/// The text without what stands in elements of this name: gnuplot names every curve, and a browser shows that under the mouse.
std::string without(std::string text, const std::string& element) {
    for (std::size_t begin = 0; (begin = text.find("<" + element + ">", begin)) != std::string::npos;) {
        const std::size_t end = text.find("</" + element + ">", begin);
        text.erase(begin, end == std::string::npos ? end : end + element.size() + 3 - begin);
    }
    return text;
}

}  // namespace

std::string without_names(std::string svg) {
    return without(without(std::move(svg), "title"), "desc");
}

GnuplotOutput run_gnuplot(const std::string& commands) {
    const MemoryFile script;
    const MemoryFile picture;
    const MemoryFile complaints;
    script.fill(commands);
    const End end = spawn_gnuplot(script, picture, complaints);
    GnuplotOutput output;
    if (end.not_started == ENOENT || end.status == 127) {
        output.problem = "gnuplot is not installed (Debian: apt-get install gnuplot-nox)";
    } else if (end.not_started != 0) {
        output.problem = std::string("gnuplot cannot be started: ") + std::strerror(end.not_started);
    } else if (output.picture = end.status == 0 ? picture.text() : ""; output.picture.empty()) {
        output.problem = "gnuplot failed: " + last_line(complaints.text());
    }
    return output;
}

}  // namespace coagula::report
