#include "terminal/processor_quota.h"

#include <bdpt/thread_limit.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "terminal/cgroup_limits.h"

namespace bdpt::app {

void within_quota(const std::function<void()>& work)
{
    const int quota = cgroup_limits().processors.value_or(int{tbb::task_arena::automatic});
    const int available = tbb::this_task_arena::max_concurrency();
    const int allowed = limit_threads(quota > 0 ? std::min(quota, available) : available).allowed;
    if (allowed < available) {
        tbb::task_arena(allowed).execute(work);
    } else {
        work();
    }
}

}  // namespace bdpt::app
