#include "threads/threads.h"

#include <bdpt/thread_limit.h>

#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <latch>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

namespace bdpt {
namespace {

/// Returns the number of additional threads that can be started, at most `wanted`.
int startable_threads(int wanted)
{
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(wanted));
    std::latch end(1);
    try {
        while (static_cast<int>(threads.size()) < wanted) {
            threads.emplace_back([&end] { end.wait(); });
        }
    } catch (const std::system_error&) {
        // The thread limit has been reached.
    } catch (const std::bad_alloc&) {
        // There is no memory for another stack.
    }
    end.count_down();
    for (std::thread& thread : threads) {
        thread.join();
    }
    return static_cast<int>(threads.size());
}

/// Limits known so far.
struct Knowledge {
    std::mutex mutex;
    int possible = 1;  ///< maximum number of threads
    int refused = 0;   ///< number of threads that was refused
    std::optional<tbb::global_control> limit;
};

Knowledge& knowledge()
{
    static Knowledge result;
    return result;
}

/// Reserve for a process that reads volumes, which takes five threads, and for a thread that
/// communicates with a viewer.
constexpr int spared_threads = 6;

}  // namespace

ThreadLimit limit_threads(int wanted)
{
    const int threads = wanted > 0 ? wanted : tbb::this_task_arena::max_concurrency();
    Knowledge& known = knowledge();
    const std::lock_guard lock(known.mutex);
    if (threads > known.possible && !known.limit) {
        const int more = startable_threads(threads - 1 + spared_threads);
        known.possible = std::max(1, 1 + more - spared_threads);
        if (known.possible < threads) {
            known.refused = threads;
            known.limit.emplace(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(known.possible));
            // The system counts threads for a moment after they have ended.
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
    }
    // Within a limit arenas are no larger than it, so their size does not tell the wanted number.
    const bool limited = wanted == 0 && threads >= known.possible;
    return {.wanted = limited ? std::max(threads, known.refused) : threads,
            .allowed = std::min(threads, known.possible)};
}

void run_both(const std::function<void()>& first, const std::function<void()>& second)
{
    tbb::parallel_invoke(first, second);
}

}  // namespace bdpt
