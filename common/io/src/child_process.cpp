// SPDX-License-Identifier: GPL-3.0-or-later
#include "child_process.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/standard_descriptors.hpp>

#include <fcntl.h>
#include <hdf5.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

namespace coagula::io {

namespace {

/// How the child ended: the first character of what it sends.
enum class Outcome : char { done = 'd', bad_input = 'i', wrong_argument = 'a', failed = 'f', out_of_memory = 'm' };

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what + ": " + std::generic_category().message(errno));
}

[[noreturn]] void fail_damaged(const std::string& path) {
    throw InputError(path + " is damaged: its structure cannot be followed; restore the file from a copy or make it again");
}

/// A descriptor that is closed at the end of its life.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    int get() const { return number_; }
    void close() {
        if (number_ >= 0) {
            ::close(number_);
        }
        number_ = -1;
    }

private:
    int number_;
};

/// Address space in use [byte]; the first number of /proc/self/statm is in pages.
std::uint64_t memory_in_use() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Lowers a limit; what it was.
template <class Resource>
rlimit lower_limit(Resource resource, rlim_t value) {
    rlimit before{};
    getrlimit(resource, &before);
    rlimit limit = before;
    limit.rlim_cur = std::min(value, before.rlim_cur);
    setrlimit(resource, &limit);
    return before;
}

void write_all(int pipe, const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = write(pipe, bytes.data() + done, bytes.size() - done);
        if (written < 0 && errno != EINTR) {
            _exit(1);
        }
        done += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    }
}

/// Debian's libhdf5 has one lock for all threads. A child that inherits it from another thread, such as one of h5py, waits for it
/// for ever. HDF5 calls what walks over properties with the lock held by this thread, to which it also belongs in the child.
pid_t fork_with_lock_of_hdf5() {
    pid_t child = -1;
    const auto fork_once = [](hid_t /*list*/, const char* /*property*/, void* result) -> herr_t {
        *static_cast<pid_t*>(result) = fork();
        return 1;
    };
    H5Piterate(H5P_DATASET_XFER, nullptr, fork_once, &child);
    return child;
}

using Work = std::function<std::string(ReadingLimits&)>;

std::string outcome_of(const Work& work, ReadingLimits& limits) {
    const auto told = [](Outcome outcome, const std::string& text) { return static_cast<char>(outcome) + text; };
    try {
        return told(Outcome::done, work(limits));
    } catch (const InputError& error) {
        return told(Outcome::bad_input, error.what());
    } catch (const std::invalid_argument& error) {
        return told(Outcome::wrong_argument, error.what());
    } catch (const std::bad_alloc&) {
        return limits.lifted() ? told(Outcome::out_of_memory, "") : "";
    } catch (const std::exception& error) {
        return told(Outcome::failed, error.what());
    }
}

/// The life of the child. It dies with its parent, leaves no core file and prints nothing.
[[noreturn]] void be_child(pid_t parent, int pipe, std::uint64_t length, const Work& work) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) {
        _exit(1);
    }
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDERR_FILENO);
    ReadingLimits limits(length);
    prctl(PR_SET_DUMPABLE, 0);
    write_all(pipe, outcome_of(work, limits));
    _exit(0);
}

std::string read_all(int pipe) {
    std::string bytes;
    std::array<char, 1 << 16> buffer{};
    for (;;) {
        const ssize_t count = read(pipe, buffer.data(), buffer.size());
        if (count == 0) {
            return bytes;
        }
        if (count < 0 && errno != EINTR) {
            fail("cannot read from a child process");
        }
        bytes.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
}

int wait_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Signals that somebody sent; all others are the child's own doing.
bool was_killed(int status) {
    constexpr std::array sent{SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT};
    return WIFSIGNALED(status) && std::find(sent.begin(), sent.end(), WTERMSIG(status)) != sent.end();
}

std::string result_of(const std::string& path, std::string told, int status) {
    if (was_killed(status)) {
        throw std::runtime_error("the process that reads " + path + " was killed");
    }
    if (told.empty() || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        fail_damaged(path);
    }
    const auto outcome = static_cast<Outcome>(told.front());
    told.erase(0, 1);
    switch (outcome) {
        case Outcome::done:
            return told;
        case Outcome::bad_input:
            throw InputError(told);
        case Outcome::wrong_argument:
            throw std::invalid_argument(told);
        case Outcome::failed:
            throw std::runtime_error(told);
        case Outcome::out_of_memory:
            throw std::bad_alloc();
    }
    fail_damaged(path);
}

}  // namespace

/// A file of usual size is read in milliseconds. A long one needs no more than a second for 4 MB, and its values at most a thousand
/// times its length, which is the most that deflate can do.
ReadingLimits::ReadingLimits(std::uint64_t file_length)
    : time_(lower_limit(RLIMIT_CPU, 1 + file_length / 4'000'000)),
      memory_(lower_limit(RLIMIT_AS, memory_in_use() + (std::uint64_t{1} << 29) + 4096 * file_length)) {}

void ReadingLimits::lift() {
    setrlimit(RLIMIT_CPU, &time_);
    setrlimit(RLIMIT_AS, &memory_);
    lifted_ = true;
}

std::string run_in_child(const std::string& path, const Work& work) {
    std::error_code missing;
    const std::uintmax_t length = std::filesystem::file_size(path, missing);
    std::array<int, 2> ends{};
    occupy_standard_descriptors();  // the child gives up that of standard error
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        fail("cannot make a pipe to read " + path);
    }
    const Descriptor from_child(ends[0]);
    Descriptor to_parent(ends[1]);
    const pid_t parent = getpid();
    const pid_t child = fork_with_lock_of_hdf5();
    if (child < 0) {
        fail("cannot start a process to read " + path);
    }
    if (child == 0) {
        be_child(parent, to_parent.get(), missing ? 0 : length, work);
    }
    to_parent.close();
    std::string told = read_all(from_child.get());
    return result_of(path, std::move(told), wait_for(child));
}

}  // namespace coagula::io
