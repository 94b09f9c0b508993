// SPDX-License-Identifier: GPL-3.0-or-later
// Independent pieces of work on several threads.
#include <coagula/common/parallel.hpp>

#include <gtest/gtest.h>

#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace {

using coagula::run_together;
using coagula::threads_within_limits;
using coagula::usable_threads;

/// As many threads as a test asks for, whatever the machine has.
class RunTogether : public testing::Test {
protected:
    void SetUp() override { omp_set_num_threads(4); }
    void TearDown() override { omp_set_num_threads(before_); }

private:
    int before_ = omp_get_max_threads();
};

TEST_F(RunTogether, CallsEachOnce) {
    std::vector<int> calls(100, 0);
    run_together(calls.size(), [&](std::size_t k) { ++calls[k]; });
    EXPECT_EQ(calls, std::vector<int>(100, 1));
    run_together(0, [](std::size_t) { FAIL(); });
}

TEST_F(RunTogether, KeepsToAsManyAtOnceAsAreAllowed) {
    for (const int allowed : {1, 3}) {
        std::atomic<int> running = 0;
        std::atomic<int> most = 0;
        run_together(
            200,
            [&](std::size_t) {
                const int now = ++running;
                for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
                }
                --running;
            },
            static_cast<std::size_t>(allowed));
        EXPECT_LE(most, allowed);
    }
}

/// Threads can be had as many as there is address space for: 192 MB each.
TEST(ThreadsWithinLimits, FollowTheAddressSpace) {
    EXPECT_EQ(threads_within_limits(3), 3);
    const int most = std::min(omp_get_num_procs(), omp_get_thread_limit());
    EXPECT_EQ(usable_threads(1), 1);
    EXPECT_EQ(usable_threads(4096), most);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t used = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    for (const int expected : {0, 1, 2}) {
        const rlimit limit{used + static_cast<rlim_t>(expected) * (rlim_t{200} << 20) + (rlim_t{40} << 20), before.rlim_max};
        ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
        const int found = threads_within_limits(4);
        const int usable = usable_threads(4);
        ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
        EXPECT_EQ(found, expected);
        EXPECT_EQ(usable, std::max(1, std::min(expected, most)));
    }
}

TEST_F(RunTogether, ThrowsTheFirstExceptionAndBeginsNothingMore) {
    std::atomic<int> begun = 0;
    const auto fail = [&](std::size_t) {
        ++begun;
        throw std::runtime_error("spheres");
    };
    EXPECT_THROW(run_together(1000, fail), std::runtime_error);
    EXPECT_LE(begun, 4);
}

}  // namespace
