#pragma once

#include <bdpt/io/read_limits.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bdpt::app {

/// What files may ask for, one line each: name, value, what it is about.
[[nodiscard]] std::string limits_text(const io::ReadLimits& limits);

/// The same as names and numbers.
[[nodiscard]] nlohmann::ordered_json limits_json(const io::ReadLimits& limits);

}  // namespace bdpt::app
