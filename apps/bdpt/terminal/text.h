#pragma once

#include <string>
#include <string_view>

namespace bdpt::app {

/// `text` without line breaks and with what is not UTF-8 replaced.
[[nodiscard]] std::string one_line(std::string_view text);

/// Seconds as "1:07" or "2:03:09".
[[nodiscard]] std::string clock_time(double seconds);

}  // namespace bdpt::app
