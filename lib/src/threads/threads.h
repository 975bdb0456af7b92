#pragma once

#include <bdpt/thread_limit.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace bdpt {

/// The threads of one render.
class Threads {
public:
    /// `wanted` 0: those that the caller's thread would use for any work with oneTBB. That makes no
    /// arena, and before version 2021.9 oneTBB frees arenas late when they come in quick
    /// succession.
    explicit Threads(int wanted)
    {
        limit_threads(wanted);
        if (wanted == 0) {
            return;
        }
        // More than there are processors must be allowed. The least of all allowances counts in a
        // process, so nobody takes one that is not needed.
        if (wanted > allowed()) {
            allowance_.emplace(parallelism, static_cast<std::size_t>(wanted));
        }
        arena_.emplace(std::min(wanted, allowed()));
    }

    /// Does `work`, and nothing else that the calling thread may have to do.
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

}  // namespace bdpt
