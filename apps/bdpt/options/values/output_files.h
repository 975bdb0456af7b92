#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "options/values/file_set.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

/// Types of images that bdpt writes.
enum class ImageType : std::uint8_t { exr, hdr, png, jpeg, webp };

/// Returns the type by the name of `output`; none: unknown.
[[nodiscard]] std::optional<ImageType> find_type(const std::filesystem::path& output);

/// Tests whether `output` is named as an image that is tone-mapped for screens, not as linear
/// radiance.
[[nodiscard]] bool is_for_screens(const std::filesystem::path& output);

/// Tests whether the name of `file` ends with `extension`, such as ".exr", in small or capital
/// letters.
[[nodiscard]] bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// Throws `Error` (usage) for an output that is also in `inputs`, which it would overwrite.
void check_not_read(std::span<const std::filesystem::path> outputs, const FileSet& inputs);

/// Checks, before anything is rendered, that outputs can be written. Throws `Error`: usage for a
/// file type that bdpt does not write, for a file that is also in `inputs` and for one that is
/// named twice; output for a place where nothing can be written.
void check_outputs(std::span<const std::filesystem::path> outputs, const FileSet& inputs);

/// Checks a file that `option` names. Throws `Error`: usage if it is an input or one of `outputs`,
/// output for a place where nothing can be written.
void check_output(std::string_view option, const std::filesystem::path& file, const FileSet& inputs,
                  const FileSet& outputs);

/// Tests whether `file` is an image or a file of --stats that bdpt wrote.
[[nodiscard]] bool is_file_of_ours(const std::filesystem::path& file);

/// Tests whether one of `outputs` is an EXR file.
[[nodiscard]] bool writes_exr(std::span<const std::filesystem::path> outputs);

/// Returns the temporary paths of the outputs, and whether one is sent to a reader.
[[nodiscard]] PendingOutputs pending_outputs(std::span<const std::filesystem::path> outputs);

}  // namespace bdpt::app
