// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a test and says how much processor time it took, its children's included: processor_time COMMAND...
// COAGULA_PROCESSOR_LIMIT is what the tier of the test allows, in turns of a fixed loop that is timed beside it: a machine that is
// slow at one is slow at the other. A test that takes more is reported; with COAGULA_PROCESSOR_GATE set it fails.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr double usual_turn = 0.02;  ///< seconds of a turn on a machine of 2026 with two processors

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Processor time of this process (RUSAGE_SELF) or of the children it has waited for (RUSAGE_CHILDREN), in s.
double processor_time(int whose) {
    rusage usage{};
    getrusage(whose, &usage);
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
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
        std::perror("processor_time");
        return 1;
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Sorts the same numbers and adds up their roots. The sum is returned so that no compiler leaves the loop out.
double turn() {
    std::vector<double> numbers(1U << 18U);
    std::uint64_t state = 1;
    for (double& number : numbers) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        number = static_cast<double>(state >> 11U);
    }
    std::sort(numbers.begin(), numbers.end());
    double sum = 0;
    for (const double number : numbers) {
        sum += std::sqrt(number);
    }
    return sum;
}

/// Processor time of a turn now, in s; NaN if the loop computes something else than numbers.
double time_of_a_turn() {
    constexpr int turns = 5;
    double sum = 0;
    const double before = processor_time(RUSAGE_SELF);
    for (int i = 0; i < turns; ++i) {
        sum += turn();
    }
    const double taken = processor_time(RUSAGE_SELF) - before;
    return sum > 0 ? taken / turns : NAN;
}

/// Says what the test took, in turns where it may be more than the limit. True if it is more.
bool over_limit(double taken, double limit) {
    const bool may_be = limit > 0 && taken > 0.4 * limit * usual_turn;  // no machine is more than 2.5 times as fast
    const double turns = may_be ? taken / time_of_a_turn() : 0;
    if (turns > limit) {
        std::fprintf(stderr, "processor time: %.2f s, %.0f turns of the loop where its tier allows %g\n", taken, turns, limit);
        return true;
    }
    std::fprintf(stderr, "processor time: %.2f s\n", taken);
    return false;
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr, "usage: processor_time COMMAND...\n");
        return 2;
    }
    const int status = run(words + 1);
    const char* limit = std::getenv("COAGULA_PROCESSOR_LIMIT");
    if (limit == nullptr) {
        return status;  // not a test: the list of tests is asked for
    }
    const bool over = over_limit(processor_time(RUSAGE_CHILDREN), std::atof(limit));
    if (over && std::getenv("COAGULA_PROCESSOR_GATE") != nullptr) {
        std::fprintf(stderr, "FAILED: make the test smaller or move it in tests/tiers.cmake\n");
        return status == 0 ? 1 : status;
    }
    return status;
}
