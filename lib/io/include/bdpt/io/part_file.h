#pragma once

/// @file
/// Keeps the samples of a render in files, to go on later or to merge those of several machines;
/// and the rates of an adaptive render, for all machines that take part.
///
/// @code{.cpp}
/// bdpt::RenderResult merged(const std::vector<std::filesystem::path>& files)
/// {
///     bdpt::RenderResult sum;
///     for (const std::filesystem::path& file : files) {
///         bdpt::io::merge_part(sum, bdpt::io::read_part_info(file));
///     }
///     return sum;
/// }
/// @endcode
///
/// @code{.cpp}
/// void write_rates_for_farm(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::io::write_rates("rates.exr", bdpt::sample_rates(scene, camera, {}), {});
///     const bdpt::SampleRates rates = bdpt::io::read_rates("rates.exr");  // on each machine
///     std::cout << rates.mean() << " samples a round\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/io/write_image.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_result.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/part/sample_set.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::io {

/// Notes in a part file for people and programs, beside the part itself.
struct PartNotes {
    /// Samples requested from its render, as far as that was limited.
    SampleSet goal;
    ImageMetadata metadata;  ///< metadata of images made from the part
    /// Words of a command that renders such samples, to which ranges and files are to be added; may
    /// be empty.
    std::vector<std::string> command{};
};

/// Description of a part file.
struct PartInfo {
    std::filesystem::path file;
    Identity identity;
    SampleSet samples;
    PartNotes notes;
    ContentHash hash;  ///< hash of the whole file
};

/// Treatment of an existing file of that name.
enum class OldPart : std::uint8_t {
    /// Keeps the file if it belongs to the same render and has all samples of the new one and more:
    /// its writer is ahead of this process.
    keep_if_more,
    replace,
};

/// Outcome of writing a part.
enum class PartWrite : std::uint8_t {
    written,
    kept,  ///< the existing file is ahead and was kept
};

/// Writes `part` as an OpenEXR file of two parts, atomically: the image, for any viewer, and its
/// sums, from which renders continue. Camera samples and splats are stored in one. Throws `Error`:
/// output, also if the existing file is a part of another render and `old` is not `replace`.
BDPT_EXPORT PartWrite write_part(const std::filesystem::path& file, const RenderResult& part,
                                 const PartNotes& notes, OldPart old);

/// Checks that a part file is intact and reads all but its sums. Throws `Error`: not_found;
/// invalid_input for files that are truncated, changed or something else.
[[nodiscard]] BDPT_EXPORT PartInfo read_part_info(const std::filesystem::path& file);

/// Merges the part in the file of `info` into `part`, which takes it unchanged if it has no
/// samples. Works row by row: there is no second film in memory. Throws `Error`: those of
/// `read_part_info` and `merge`, and invalid_input if the file has changed since `info` was read.
/// After a failure the contents of `part` are invalid. The films of a part without samples are
/// taken from `memory`, if given.
BDPT_EXPORT void merge_part(RenderResult& part, const PartInfo& info,
                            MemoryBudget* memory = nullptr);

/// Writes rates as an OpenEXR image of halves, which hold them exactly: R, G and B are the samples
/// that the pixel takes in a round, 0.25 to 4. Written atomically. Throws `Error` (output).
BDPT_EXPORT void write_rates(const std::filesystem::path& file, const SampleRates& rates,
                             const ImageMetadata& metadata);

/// Reads a file in the format of `write_rates`, whoever made it. Throws `Error`, whose message
/// starts with the file's path: those of `read_image`, and invalid_input for a cropped image and
/// for pixels that are no power of two from 1/4 to 4.
[[nodiscard]] BDPT_EXPORT SampleRates read_rates(const std::filesystem::path& file);

}  // namespace bdpt::io
