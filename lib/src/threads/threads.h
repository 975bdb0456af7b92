#pragma once

#include <bdpt/thread_limit.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>

namespace bdpt {

/// The threads of one render.
class Threads {
public:
    /// `wanted` 0 uses the threads that oneTBB would give to the calling thread. That creates no
    /// arena; before version 2021.9 oneTBB frees arenas late when they are created in quick
    /// succession.
    explicit Threads(int wanted)
    {
        limit_threads(wanted);
        if (wanted == 0) {
            return;
        }
        // More threads than processors must be allowed explicitly. The smallest allowance in a
        // process applies, so none is created without need.
        if (wanted > allowed()) {
            allowance_.emplace(parallelism, static_cast<std::size_t>(wanted));
        }
        arena_.emplace(std::min(wanted, allowed()));
    }

    /// Runs `work`, and no other tasks of the calling thread.
    template <typename Work>
    void execute(const Work& work)
    {
        if (arena_) {
            arena_->execute(work);
        } else {
            tbb::this_task_arena::isolate(work);
        }
    }

private:
    static constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
    static int allowed()
    {
        return static_cast<int>(tbb::global_control::active_value(parallelism));
    }

    std::optional<tbb::global_control> allowance_;
    std::optional<tbb::task_arena> arena_;
};

/// Runs both functions, side by side if another thread is idle. Throws what they throw.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace bdpt
