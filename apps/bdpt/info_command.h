#pragma once

#include <optional>
#include <string>

#include "console.h"

namespace CLI {
class App;
}

namespace bdpt::app {

struct InfoArguments {
    std::string file;
    std::optional<std::string> scene;  ///< name or index
    bool json = false;
};

/// Describes the options of `bdpt info` to the parser, which will store into `arguments`.
void add_info_options(CLI::App& command, InfoArguments& arguments);

/// `bdpt info`: prints what a file holds on stdout. The result is the exit code. Throws `Error`.
[[nodiscard]] int run_info(const InfoArguments& arguments);

}  // namespace bdpt::app
