// Runs a test and says how much processor time it took, its children's included: processor_limit COMMAND...
// With COAGULA_PROCESSOR_LIMIT=SECONDS above zero a test that takes longer fails, so that the tiers stay what they are.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace {

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Exit status of the command, or 128 + signal as a shell has it.
int run(char** command) {
    const pid_t child = fork();
    if (child == 0) {
        execvp(command[0], command);
        std::perror(command[0]);
        _exit(127);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child) {
        std::perror("processor_limit");
        return 1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr, "usage: processor_limit COMMAND...\n");
        return 2;
    }
    const int status = run(words + 1);
    const char* text = std::getenv("COAGULA_PROCESSOR_LIMIT");
    if (text == nullptr) {
        return status;  // not a test: the list of tests is asked for
    }
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const double taken = seconds(usage.ru_utime) + seconds(usage.ru_stime);
#ifdef COAGULA_NO_LIMIT  // sanitizers cost a factor
    const double limit = 0;
#else
    const double limit = std::atof(text);
#endif
    std::fprintf(stderr, "processor time: %.2f s\n", taken);
    if (limit > 0 && taken > limit) {
        std::fprintf(stderr, "FAILED: the fast tier allows %g s; make the test smaller or move it in tests/tiers.cmake\n", limit);
        return status == 0 ? 1 : status;
    }
    return status;
}
