#pragma once

#include <functional>

namespace bdpt {

/// Runs both functions, side by side if another thread is idle. Throws what they throw.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace bdpt
