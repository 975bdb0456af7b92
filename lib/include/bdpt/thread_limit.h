#pragma once

#include <bdpt/export.h>

namespace bdpt {

/// Threads of this process, that of the caller among them.
struct ThreadLimit {
    int wanted = 1;
    int allowed = 1;  ///< at most `wanted`
};

/// Finds out whether the system lets this process have `wanted` threads (0: as many as oneTBB would
/// take here), by starting that many for a moment. Users and containers may have a limit, and
/// oneTBB ends the process when it meets that; so where there are fewer, it gets no more than those
/// from now on. What renders calls this; who uses oneTBB before does, too.
BDPT_EXPORT ThreadLimit limit_threads(int wanted);

}  // namespace bdpt
