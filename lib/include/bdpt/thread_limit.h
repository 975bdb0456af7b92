#pragma once

/// @file
/// Finds out how many threads the system allows.
///
/// @code{.cpp}
/// const bdpt::ThreadLimit limit = bdpt::limit_threads(64);
/// if (limit.allowed < limit.wanted) {
///     std::cerr << "the system allows " << limit.allowed << " threads\n";
/// }
/// @endcode

#include <bdpt/export.h>

namespace bdpt {

/// Threads of this process, including the caller's.
struct ThreadLimit {
    int wanted = 1;
    int allowed = 1;  ///< at most `wanted`
};

/// Determines whether the system lets this process have `wanted` threads (0: as many as oneTBB
/// would use here) by briefly starting that many. Users and containers may have a limit, and oneTBB
/// terminates the process when it hits that limit; so if fewer are allowed, oneTBB is restricted to
/// them from now on. All rendering functions call this; call it yourself if you use oneTBB earlier.
BDPT_EXPORT ThreadLimit limit_threads(int wanted);

}  // namespace bdpt
