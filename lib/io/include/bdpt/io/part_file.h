#pragma once

/// @file
/// Keeps the samples of a render in files, to go on later or to merge those of several machines.
///
/// @code{.cpp}
/// bdpt::RenderPart merged(const std::vector<std::filesystem::path>& files)
/// {
///     bdpt::RenderPart sum;
///     for (const std::filesystem::path& file : files) {
///         bdpt::io::merge_part(sum, bdpt::io::read_part_info(file));
///     }
///     return sum;
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/io/memory_budget.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_part.h>
#include <bdpt/part/sample_set.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::io {

/// Notes of a part file for people and programs, beside the part itself.
struct PartNotes {
    /// Samples that its render was asked for, as far as that had an end.
    SampleSet goal;
    ImageMetadata metadata;  ///< of images that are made of it
    /// Words of a command that renders such samples, to which ranges and files are to be added;
    /// may be empty.
    std::vector<std::string> command{};
};

/// The description in a part file.
struct PartInfo {
    std::filesystem::path file;
    Identity identity;
    SampleSet samples;
    PartNotes notes;
    ContentHash hash;  ///< of the whole file
};

/// The treatment of an existing file of that name.
enum class OldPart : std::uint8_t {
    /// Stays if it is of the same render, and has all samples of the new one and more: whoever
    /// wrote it is ahead of us.
    keep_if_more,
    replace,
};

/// The outcome of writing the new part.
enum class PartWrite : std::uint8_t {
    written,
    kept,  ///< the file there is ahead, and stays
};

/// Writes `part` as an OpenEXR file of two parts, atomically: the image, which any viewer shows,
/// and its sums, from which renders go on. Camera samples and splats are stored in one, which no
/// image shows. Throws `Error`: output, also when the file there is a part of another render and
/// `old` is not `replace`.
BDPT_EXPORT PartWrite write_part(const std::filesystem::path& file, const RenderPart& part,
                                 const PartNotes& notes, OldPart old);

/// Checks that all of a part file is as it was written and reads all but its sums. Throws `Error`:
/// not_found; invalid_input for files that were cut off or changed, or that are something else.
[[nodiscard]] BDPT_EXPORT PartInfo read_part_info(const std::filesystem::path& file);

/// Merges the part in the file of `info` into `part`, which takes it as it is if it has no samples.
/// A row at a time: there is no second film in memory. Throws `Error`: what `read_part_info` and
/// `merge` do, and invalid_input when the file is not the one that it was when `info` was read.
/// After a failure nothing in `part` is of use. The films of a part without samples are taken from
/// `memory`, if there is one.
BDPT_EXPORT void merge_part(RenderPart& part, const PartInfo& info, MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
