#pragma once

#include <string>

#include "options/groups/scene_arguments.h"

namespace CLI {
class App;
}

namespace bdpt::app {

struct InfoArguments {
    std::string file;  ///< empty: only the limits
    SceneWords scene;
    bool limits = false;  ///< print those that files are read with
    bool json = false;
};

/// Describes the options of `bdpt info` to the parser, which will store into `arguments`.
void add_info_options(CLI::App& command, InfoArguments& arguments);

/// `bdpt info`: prints what a file holds on stdout. The result is the exit code. Throws `Error`.
[[nodiscard]] int run_info(const InfoArguments& arguments);

}  // namespace bdpt::app
