#pragma once

#include <bdpt/io/read_limits.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// Returns the limits of files, one line each: name, value, subject.
[[nodiscard]] std::string limits_text(const io::ReadLimits& limits);

/// Returns the limits as names and numbers.
[[nodiscard]] nlohmann::ordered_json limits_json(const io::ReadLimits& limits);

}  // namespace bdpt::app
