#pragma once

#include <cstdio>
#include <optional>
#include <string_view>

namespace bdpt::app {

/// Opens /dev/null for standard streams that are closed, so that no file opened later gets their
/// number. Writes to a closed standard output still fail; a closed standard error suppresses
/// messages. Call it before any other code runs.
void guard_standard_streams();

/// Prints at once. Failures, by a full disk or a reader that left, must not end a render, so
/// `finish_standard_streams` reports them at the end.
void put(std::FILE* stream, std::string_view text);

/// Prints help on the standard output. A reader that leaves early, such as head, is no failure.
void put_help(std::string_view text);

/// Returns the width of the standard output's terminal; none: it is no terminal.
[[nodiscard]] std::optional<int> output_columns();

/// Closes both streams. Returns `exit_code`, or that of a failed output, with a message, if all
/// else succeeded but printed text was lost.
[[nodiscard]] int finish_standard_streams(int exit_code);

}  // namespace bdpt::app
