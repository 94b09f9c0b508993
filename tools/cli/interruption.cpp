// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.hpp"

#include <coagula/io/unfinished_file.hpp>

#include <unistd.h>

#include <array>
#include <csignal>
#include <string_view>

namespace coagula::tools {

namespace {

volatile std::sig_atomic_t stop_requested = 0;
pid_t program = 0;  // handlers are inherited by the children that read files

constexpr std::array stopping = {SIGINT, SIGTERM};
constexpr unsigned patience = 1;  // s

void say(std::string_view text) {
    if (write(STDERR_FILENO, text.data(), text.size()) < 0) {
        return;  // nobody listens
    }
}

/// A long step in a library, or one that waits for something that never comes, does not look at the request.
void end_program(int /*signal*/) {
    if (getpid() == program) {
        io::remove_unfinished_files();
        say(isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "");  // the progress bar
        say("coagula: interrupted: what was not complete is not written\n");
    }
    _exit(1);
}

/// The next signal, whichever of them it is, finds the default action and ends the program.
void request_stop(int /*signal*/) {
    stop_requested = 1;
    for (const int number : stopping) {
        std::signal(number, SIG_DFL);
    }
    alarm(patience);
}

void handle(int number, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;  // a write in progress is not cut short
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, nullptr);
}

}  // namespace

void install_signal_handlers() {
    program = getpid();
    for (const int number : stopping) {
        handle(number, request_stop);
    }
    handle(SIGALRM, end_program);
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGCHLD, SIG_DFL);
}

bool interrupted() {
    if (stop_requested != 0) {
        alarm(0);
    }
    return stop_requested != 0;
}

}  // namespace coagula::tools
