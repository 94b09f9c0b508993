#include "interruption.hpp"

#include <array>
#include <csignal>

namespace coagula::tools {

namespace {

volatile std::sig_atomic_t stop_requested = 0;

constexpr std::array stopping = {SIGINT, SIGTERM};

/// The next signal, whichever of them it is, finds the default action and ends the program.
void request_stop(int /*signal*/) {
    stop_requested = 1;
    for (const int number : stopping) {
        std::signal(number, SIG_DFL);
    }
}

}  // namespace

void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = request_stop;
    action.sa_flags = SA_RESTART;  // a write in progress is not cut short
    sigemptyset(&action.sa_mask);
    for (const int number : stopping) {
        sigaction(number, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
    return stop_requested != 0;
}

}  // namespace coagula::tools
