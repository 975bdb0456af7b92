#pragma once

#include <span>
#include <string>

#include "command_info.h"

namespace bdpt::manual {

// Scripts that let a shell complete commands, options, their words and files.

[[nodiscard]] std::string bash_completion(std::span<const CommandInfo> commands);
[[nodiscard]] std::string zsh_completion(std::span<const CommandInfo> commands);
[[nodiscard]] std::string fish_completion(std::span<const CommandInfo> commands);

}  // namespace bdpt::manual
