#include "threads/threads.h"

#include <tbb/parallel_invoke.h>

namespace bdpt {

void run_both(const std::function<void()>& first, const std::function<void()>& second)
{
    tbb::parallel_invoke(first, second);
}

}  // namespace bdpt
