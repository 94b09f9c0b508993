// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_pool.hpp"

#include <coagula/common/failures.hpp>
#include <coagula/io/unfinished_file.hpp>

#include <omp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

namespace coagula::stages {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr std::size_t most_jobs = 1024;

/// What the processes share.
struct Board {
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> done{0};
    std::array<std::atomic<std::size_t>, most_jobs> current{};
    std::atomic<int> failed{0};
    std::array<char, 2000> sentence{};
};

class SharedBoard {
public:
    SharedBoard() {
        void* memory = mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) {
            throw std::runtime_error(std::string("no memory to share with other processes: ") + std::strerror(errno));
        }
        board_ = new (memory) Board;
    }
    SharedBoard(const SharedBoard&) = delete;
    SharedBoard& operator=(const SharedBoard&) = delete;
    ~SharedBoard() { munmap(board_, sizeof(Board)); }
    Board& operator*() const { return *board_; }
    Board* operator->() const { return board_; }

private:
    Board* board_ = nullptr;
};

class Children {
public:
    Children(const Pool& pool, Board& board) : pool_(pool), board_(board), pids_(static_cast<std::size_t>(pool.jobs), 0) {}
    Children(const Children&) = delete;
    Children& operator=(const Children&) = delete;
    ~Children() {
        for (const pid_t pid : pids_) {
            if (pid > 0) {
                kill(pid, SIGKILL);
                waitpid(pid, nullptr, 0);
            }
        }
    }

    void start(std::size_t slot) {
        board_.current[slot] = none;
        const pid_t parent = getpid();
        const pid_t pid = fork();
        if (pid < 0) {
            throw std::runtime_error(std::string("no further process can be started: ") + std::strerror(errno));
        }
        if (pid == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            _exit(getppid() == parent ? child(slot) : 1);
        }
        pids_[slot] = pid;
    }

    /// Looks whether children have ended, and starts new ones where work is left. False: all have ended.
    bool tend(PoolState& state) {
        bool any = false;
        for (std::size_t slot = 0; slot < pids_.size(); ++slot) {
            int status = 0;
            if (pids_[slot] > 0 && waitpid(pids_[slot], &status, WNOHANG) == pids_[slot]) {
                pids_[slot] = 0;
                if (WIFSIGNALED(status)) {
                    bury(slot, WTERMSIG(status), state);
                }
                if (board_.failed == 0 && board_.next < pool_.pieces) {
                    start(slot);
                }
            }
            any = any || pids_[slot] > 0;
        }
        state.done = board_.done;
        return any;
    }

private:
    int child(std::size_t slot) const {
        omp_set_num_threads(pool_.threads);
        try {
            for (std::size_t piece = board_.next++; piece < pool_.pieces && board_.failed == 0; piece = board_.next++) {
                board_.current[slot] = piece;
                pool_.work(piece);
                board_.current[slot] = none;
                ++board_.done;
            }
            return 0;
        } catch (const std::exception& error) {
            if (board_.failed++ == 0) {
                const std::string sentence = failure_sentence(error);
                sentence.copy(board_.sentence.data(), board_.sentence.size() - 1);
            }
            io::remove_unfinished_files();
            return 1;
        }
    }

    void bury(std::size_t slot, int signal, PoolState& state) {
        const std::size_t piece = board_.current[slot];
        if (piece != none) {
            ++state.died;
            ++board_.done;
            const std::string hint = signal == SIGKILL ? ", which a system short of memory sends" : "";
            pool_.died(piece, "its process was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")" + hint);
        }
    }

    const Pool& pool_;
    Board& board_;
    std::vector<pid_t> pids_;
};

}  // namespace

void run_pool(const Pool& pool) {
    const SharedBoard board;
    Children children(pool, *board);
    omp_pause_resource_all(omp_pause_hard);  // a child has no threads of its parent and would wait for them for ever
    for (std::size_t slot = 0; slot < std::min(static_cast<std::size_t>(pool.jobs), pool.pieces); ++slot) {
        children.start(slot);
    }
    PoolState state;
    while (children.tend(state)) {
        pool.told(state);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    if (board->failed != 0) {
        throw std::runtime_error(board->sentence.data());
    }
    pool.told(state);
}

}  // namespace coagula::stages
