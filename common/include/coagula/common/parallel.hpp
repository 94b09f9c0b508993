// Independent pieces of work on several threads.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

namespace coagula {

/// Calls work(0) ... work(count - 1), several at once where there are threads, but at most `at_once`. What a call does in parallel
/// itself then runs on its own thread alone. After an exception no further call begins; the first one is thrown again.
void run_together(std::size_t count, const std::function<void(std::size_t)>& work,
                  std::size_t at_once = std::numeric_limits<std::size_t>::max());

}  // namespace coagula
