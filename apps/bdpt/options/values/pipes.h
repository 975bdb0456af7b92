#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terminal/console.h"

namespace bdpt::app {

/// Returns "-", an EXR file, and "exr:-", "png:-" and so on.
[[nodiscard]] std::vector<std::string> standard_output_names();

/// Tests whether `output` is a name of the standard output.
[[nodiscard]] bool is_standard_output(const std::filesystem::path& output);

/// Tests whether one of `outputs` is a name of the standard output.
[[nodiscard]] bool use_standard_output(std::span<const std::filesystem::path> outputs);

/// Returns the name of the output for `io`: "-" for the standard output, else the file.
[[nodiscard]] std::filesystem::path written_file(const std::filesystem::path& output);

/// Checks that only one thing goes through each of the standard input and output. Throws
/// `OptionError` if two of `inputs` are "-", or if the lines of `format` would be mixed with an
/// output.
void check_pipes(std::span<const std::filesystem::path> inputs,
                 std::span<const std::filesystem::path> outputs, Format format);

}  // namespace bdpt::app
