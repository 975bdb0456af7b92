#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "options/values/file_set.h"

namespace bdpt::app {

/// The types of images that we write.
enum class ImageType : std::uint8_t { exr, hdr, png, jpeg, webp };

/// Has it tone-mapped images for screens, not linear radiance?
[[nodiscard]] bool is_for_screens(ImageType type);

/// By the name of `output`; none: of none of these types.
[[nodiscard]] std::optional<ImageType> type_of(const std::filesystem::path& output);

/// Does the name of `file` end with `extension`, like ".exr", in small or capital letters?
[[nodiscard]] bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// Refuses outputs that would overwrite what is read: throws `Error` (usage) for one that is also
/// in `inputs`.
void check_not_read(std::span<const std::filesystem::path> outputs, const FileSet& inputs);

/// Refuses, before anything is rendered, what could not be written afterwards: throws `Error`
/// (usage) for a file type that we do not write, for a file that is also in `inputs` and for one
/// that is named twice, (output) for a place where nothing can be written.
void check_outputs(std::span<const std::filesystem::path> outputs, const FileSet& inputs);

/// The same of a file that `option` names: throws `Error` (usage) when it is an input or one of
/// `outputs`, (output) for a place where nothing can be written.
void check_output(std::string_view option, const std::filesystem::path& file, const FileSet& inputs,
                  const FileSet& outputs);

/// Is one of `outputs` an EXR file?
[[nodiscard]] bool writes_exr(std::span<const std::filesystem::path> outputs);

/// Where the outputs grow; to be removed when the process ends in the middle.
[[nodiscard]] std::vector<std::filesystem::path> temporary_paths(
    std::span<const std::filesystem::path> outputs);

}  // namespace bdpt::app
