#pragma once

#include <cstdio>
#include <optional>
#include <string_view>

namespace bdpt::app {

/// Opens /dev/null for standard streams that are closed, so that no file that is opened later gets
/// their number. What is written to a closed standard output still fails; a closed standard error
/// is for who wants no messages. Call it before any other code runs.
void guard_standard_streams();

/// Prints at once. A full disk or a reader that left must not end a render, so that this fails is
/// told at the end, by `finish_standard_streams`.
void put(std::FILE* stream, std::string_view text);

/// The width of the terminal that the standard output is; none: it is no terminal.
[[nodiscard]] std::optional<int> output_columns();

/// Closes both streams. Returns `exit_code`, or that of an output that could not be written when
/// all else went well, but what was printed got lost; a message says so.
[[nodiscard]] int finish_standard_streams(int exit_code);

}  // namespace bdpt::app
