#pragma once

#include <span>
#include <string>

#include "command_info.h"

namespace bdpt::manual {

/// bdpt(1): the program and its commands, in the macros of man(7).
[[nodiscard]] std::string man_page(const CommandInfo& program,
                                   std::span<const CommandInfo> commands);

/// bdpt-render(1) and its like.
[[nodiscard]] std::string man_page(const CommandInfo& command);

}  // namespace bdpt::manual
