#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "messages/console.h"

namespace bdpt::job {

/// A set of files by identity, existing or not: links, hard links and other spellings of a name
/// count as the same file.
class FileSet {
public:
    FileSet() = default;
    FileSet(const std::vector<std::filesystem::path>& files) { add(files); }

    /// Adds a file; returns true if it was not in the set before.
    bool add(const std::filesystem::path& file);
    void add(const std::vector<std::filesystem::path>& files);
    [[nodiscard]] bool contains(const std::filesystem::path& file) const;

private:
    std::set<std::pair<dev_t, ino_t>> there_;
    std::set<std::filesystem::path> not_there_;
};

/// Tests whether `file`, existing or not, is in `folder` or below, with symbolic links followed.
[[nodiscard]] bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder);

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

/// Writes `text` as a file that appears under its name when it is complete. Throws `Error`
/// (output).
void write_text(const std::filesystem::path& file, const std::string& text);

/// Tests whether `file` is an image or a file of --stats that bdpt wrote.
[[nodiscard]] bool is_file_of_ours(const std::filesystem::path& file);

/// Tests whether one of `outputs` is an EXR file.
[[nodiscard]] bool writes_exr(std::span<const std::filesystem::path> outputs);

/// Returns the temporary paths of the outputs, and whether one is sent to a reader.
[[nodiscard]] PendingOutputs pending_outputs(std::span<const std::filesystem::path> outputs);

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

/// Tests whether the name of `file` has a run of '#', the placeholder of a number: "out.####.exr".
[[nodiscard]] bool takes_number(const std::filesystem::path& file);

/// Replaces the run of '#' in `file` by `number`, with leading zeros up to its length:
/// "out.0012.exr". A file without a run is unchanged. Throws `OptionError` if its name has two
/// runs.
[[nodiscard]] std::filesystem::path with_number(const std::filesystem::path& file, int number);

/// Tests whether the name of `file` has the placeholder of a camera's name: "{camera}".
[[nodiscard]] bool takes_camera(const std::filesystem::path& file);

/// Replaces "{camera}" in `file` by `camera`. Characters that cannot be in a file name (slashes,
/// control characters, a dot at its beginning) become '_'.
[[nodiscard]] std::filesystem::path with_camera(const std::filesystem::path& file,
                                                const std::string& camera);

/// Replaces "{name}" in the name of `file` by `name`, that of a scene.
[[nodiscard]] std::filesystem::path with_scene(const std::filesystem::path& file,
                                               const std::string& name);

/// Returns the default output for the scene in `file`: its name with .png, in the working
/// directory. Throws `Error` (output) if a file there is not an image of ours.
[[nodiscard]] std::filesystem::path default_output(const std::filesystem::path& file);

/// A new folder for files that only this process reads. It is removed with its contents at the end.
class TemporaryFolder {
public:
    /// Throws `Error` (output) if it cannot be created.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// Returns the path of a file in the folder.
    [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

}  // namespace bdpt::job
