#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace bdpt::app {

/// Are they one file, be it there or not?
[[nodiscard]] bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The types of images that we write.
enum class ImageType : std::uint8_t { exr, png };

/// By the name of `output`; none: of neither type.
[[nodiscard]] std::optional<ImageType> type_of(const std::filesystem::path& output);

/// Does the name of `file` end with `extension`, like ".exr", in small or capital letters?
[[nodiscard]] bool has_extension(const std::filesystem::path& file, std::string_view extension);

/// Refuses, before anything is rendered, what could not be written afterwards: throws `Error`
/// (usage) for a file type that we do not write, for a file that is also in `inputs` and for one
/// that is named twice, (output) for a place where nothing can be written.
void check_outputs(std::span<const std::filesystem::path> outputs,
                   std::span<const std::filesystem::path> inputs);

/// The same of the file of --part, which may be there already: throws `Error` (usage) when it is
/// one of `others`, (output) for a place where nothing can be written.
void check_part_file(const std::filesystem::path& file,
                     std::span<const std::filesystem::path> others);

/// Is one of `outputs` an EXR file?
[[nodiscard]] bool writes_exr(std::span<const std::filesystem::path> outputs);

/// Where the outputs grow; to be removed when the process ends in the middle.
[[nodiscard]] std::vector<std::filesystem::path> temporary_paths(
    std::span<const std::filesystem::path> outputs);

}  // namespace bdpt::app
