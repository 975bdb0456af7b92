#pragma once

#include <functional>

namespace bdpt::app {

/// Runs `work` with as many threads as the quota of a container allows, and as the system lets
/// start: oneTBB knows only the processors that the process may run on, not such limits.
void within_quota(const std::function<void()>& work);

}  // namespace bdpt::app
