#pragma once

#include <bdpt/eval/verify.h>

#include <optional>
#include <string>

#include "options/value_types.h"
#include "parser/command_parser.h"

namespace bdpt::app {

// Each function adds a command: its options, and what it does with them.

void add_render_command(Program& program);
void add_dataset_command(Program& program);
void add_view_command(Program& program);
void add_plan_command(Program& program);
void add_merge_command(Program& program);
void add_develop_command(Program& program);
void add_info_command(Program& program);
void add_compare_command(Program& program);
void add_bench_command(Program& program);
void add_verify_command(Program& program);
void add_inspect_command(Program& program);

/// Returns the size of an image of about `pixels` pixels with the proportions of `whole`.
[[nodiscard]] Size bench_size(const Size& whole, int pixels);

/// Returns the exit code of `bdpt verify`.
[[nodiscard]] int exit_code(eval::Verdict verdict);

/// Parses "HOST", "HOST:PORT", ":PORT" (this machine) or "[IPV6]:PORT", or "PORT" of 127.0.0.1;
/// without a port, or with 0, any free one.
[[nodiscard]] std::optional<NetworkAddress> parse_listen_address(const std::string& typed);

/// The program bdpt with all its commands.
struct CommandLine {
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    Program program;
};

}  // namespace bdpt::app
