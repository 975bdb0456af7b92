#pragma once

#include <bdpt/eval/verify/verify_options.h>

#include <optional>
#include <string>

#include "options/render_arguments.h"
#include "terminal/console.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// The words of `bdpt verify` as they were given.
struct VerifyWords {
    RenderWords render;  ///< what it shares with `bdpt render`; the rest is left alone
    int max_depth = eval::VerifyOptions{}.max_depth;
    int grid = eval::VerifyOptions{}.grid;
    double bias = 1.0;         // [%]
    double false_alarm = 0.1;  // [%]
};

/// What `bdpt verify` is to do.
struct VerifyArguments {
    RenderArguments stage;  ///< which scene, seen how
    eval::VerifyOptions options;
};

/// Describes the options of `bdpt verify` to the parser, which will store into `words`.
void add_verify_options(CLI::App& command, VerifyWords& words);

/// Throws `Error` (usage) for words that make no sense.
[[nodiscard]] VerifyArguments understand(const VerifyWords& words);

}  // namespace bdpt::app
