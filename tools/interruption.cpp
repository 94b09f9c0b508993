#include "interruption.hpp"

#include <csignal>

namespace coagula::tools {

namespace {

volatile std::sig_atomic_t stop_requested = 0;

void request_stop(int /*signal*/) {
    stop_requested = 1;
}

}  // namespace

void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = request_stop;
    // SA_RESETHAND: the second signal finds the default action. SA_RESTART: a write in progress is not cut short.
    action.sa_flags = static_cast<int>(SA_RESETHAND | static_cast<unsigned>(SA_RESTART));
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
    return stop_requested != 0;
}

}  // namespace coagula::tools
