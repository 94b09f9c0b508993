// Independent pieces of work on several threads.
#include <coagula/common/parallel.hpp>

#include <gtest/gtest.h>

#include <omp.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace {

using coagula::run_together;

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
