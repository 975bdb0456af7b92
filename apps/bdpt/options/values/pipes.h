#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terminal/console.h"

namespace bdpt::app {

/// "-", an EXR file, and "exr:-", "png:-" and so on.
[[nodiscard]] std::vector<std::string> standard_output_names();

/// Is it one of these?
[[nodiscard]] bool is_standard_output(const std::filesystem::path& output);

/// Is one of `outputs`?
[[nodiscard]] bool use_standard_output(std::span<const std::filesystem::path> outputs);

/// What `io` calls that output: "-" for the standard output, else the file.
[[nodiscard]] std::filesystem::path written_file(const std::filesystem::path& output);

/// One thing at a time goes through the standard input and output. Throws `OptionError` when two of
/// `inputs` are "-", and when the lines of `format` would be mixed with an output.
void check_pipes(std::span<const std::filesystem::path> inputs,
                 std::span<const std::filesystem::path> outputs, Format format);

}  // namespace bdpt::app
