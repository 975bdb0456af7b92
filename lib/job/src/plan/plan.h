#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "messages/console.h"
#include "options/render_arguments.h"

namespace bdpt::job {

/// One image of a plan.
struct PlanImage {
    std::optional<int> frame{};           ///< frame of an animation or a turntable
    std::optional<std::string> camera{};  ///< name or index, if all cameras are rendered
    std::optional<std::uint64_t> seed{};  ///< for a plan of several images
    [[nodiscard]] bool operator==(const PlanImage&) const = default;
};

/// Work of one process of a planned render.
struct PlanTask {
    std::size_t first_image = 0;  ///< index in the plan
    std::size_t images = 1;       ///< number of images to render, one after the other
    SampleRange samples;          ///< samples of each image
    std::filesystem::path part;  ///< file that it writes; with #### and {camera} for several images
    [[nodiscard]] bool operator==(const PlanTask&) const = default;
};

/// A render that is shared by several processes. Paths are absolute, or relative to the folder of
/// the plan's file, so a folder with all files may be mounted at a different place for each
/// process.
struct Plan {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> environment{};  ///< the file of --env
    std::optional<std::filesystem::path> volume{};       ///< the file of --volume
    std::optional<std::filesystem::path> rates{};  ///< the file of --rates, in the plan's folder
    /// Further words of bdpt render, the same for all tasks.
    std::vector<std::string> render_options{};
    std::vector<std::string> merge_options{};      ///< words of bdpt merge
    std::vector<std::filesystem::path> outputs{};  ///< with #### and {camera} for several images
    std::optional<std::filesystem::path> strategies{};  ///< .exr file of strategy images
    std::vector<PlanImage> images{PlanImage{}};         ///< in the order of `bdpt render`
    std::vector<PlanTask> tasks{};
    std::vector<std::filesystem::path> engine_files{};  ///< files that start the tasks
    Identity identity{};  ///< identity that each task must find; for several images the components
                          ///< they share
    Identity files{};     ///< for several images: contents of the files that they are made of
    [[nodiscard]] bool operator==(const Plan&) const = default;
};

/// Returns all samples that the tasks render of an image.
[[nodiscard]] SampleSet collect_samples(const Plan& plan);

/// Tests whether the plan was made for the images of a sequence, even for a single one.
[[nodiscard]] bool is_sequence(const Plan& plan);

/// Returns the cameras of a plan of all cameras, in their order; else none.
[[nodiscard]] std::vector<std::string> collect_cameras(const Plan& plan);

/// Returns the file of `image` by its `pattern`.
[[nodiscard]] std::filesystem::path expand_pattern(const std::filesystem::path& pattern,
                                                   const PlanImage& image);

/// Returns the label of image `image`, for messages.
[[nodiscard]] ImageLabel make_label(const Plan& plan, std::size_t image);

/// Returns "frame 3, frame 5 to frame 9" for indices of images in ascending order.
[[nodiscard]] std::string images_text(const Plan& plan, const std::vector<std::size_t>& images);

/// Returns the files that the tasks write for each image.
[[nodiscard]] std::vector<std::vector<std::filesystem::path>> parts_by_image(const Plan& plan);

/// Returns the tasks that render some of the missing samples of images, in ascending order:
/// `missing` has those of each image of the plan.
[[nodiscard]] std::vector<std::size_t> tasks_for(const Plan& plan,
                                                 const std::vector<SampleSet>& missing);

/// Returns "0-2,5" for numbers in ascending order.
[[nodiscard]] std::string numbers_text(const std::vector<std::size_t>& numbers);

/// Splits `samples` into `parts` consecutive ranges of about equal size. They end at multiples of
/// 64, or of a smaller power of two if there are too few samples: such ranges keep Sobol points
/// well spread. `parts` is in [1, number of samples]; the power of two is at least `least`, itself
/// a power of two, and there are at least `parts` multiples of it.
[[nodiscard]] std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts,
                                                     std::int64_t least = 1);

/// Returns the number of ranges that take at most `seconds` each and are of multiples of 64
/// samples, or of a power of two if 64 take longer; at least `least` samples each. A sample takes
/// `seconds_per_sample`, and a range `seconds_to_start`.
[[nodiscard]] std::int64_t parts_of_time(SampleRange samples, double seconds,
                                         double seconds_per_sample, double seconds_to_start,
                                         std::int64_t least = 1);

/// Returns `count` tasks that render `samples` of all images of `plan`, image by image. With fewer
/// tasks than images, a task takes several consecutive images; else the samples of each image are
/// split into ranges of multiples of `least` samples. `count` is in [1, images * samples / least].
[[nodiscard]] std::vector<PlanTask> split_plan(const Plan& plan, SampleRange samples,
                                               std::int64_t count, std::int64_t least = 1);

/// Returns the number of tasks for `images` images that take about `seconds` each. A sample of an
/// image takes `seconds_per_sample`, and an image `seconds_to_start`. Ranges have at least `least`
/// samples.
[[nodiscard]] std::int64_t tasks_of_time(std::size_t images, SampleRange samples, double seconds,
                                         double seconds_per_sample, double seconds_to_start,
                                         std::int64_t least = 1);

// Files in the folder of a plan: all that bdpt writes there, and all that `bdpt plan --restart`
// removes. A plan that names others was not written by bdpt.

inline constexpr const char* plan_name = "plan.json";
inline constexpr const char* rates_name = "rates.exr";

/// Tests whether `name` is the name of a file of an engine.
[[nodiscard]] bool is_engine_file(std::string_view name);

/// Returns the file of that name in `folder`, that of a plan. Throws `Error` (invalid_input) for a
/// symbolic link, which may lead anywhere.
[[nodiscard]] std::filesystem::path file_of_plan(const std::filesystem::path& name,
                                                 const std::filesystem::path& folder);

/// Format version of plan.json. It is incremented with every change that older programs would
/// misread.
inline constexpr int plan_format = 2;

/// Maximum number of parts of a plan.
inline constexpr std::size_t max_planned_parts = 1'000'000;

/// Returns the plan as JSON. Throws `Error` (usage) for a path that is not UTF-8, and for a plan
/// too large to be read again.
[[nodiscard]] std::string to_text(const Plan& plan);

/// Reads the plan in `file`, with paths as stored. The file is not trusted: parts, rates and files
/// of engines are names of files that bdpt puts into its folder (`is_part_of_task`), and options
/// are those that `bdpt plan` writes. Throws `Error`: not_found, and invalid_input for a file that
/// is no such plan, or one of another version.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// Returns a path of a plan as an absolute one.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& path,
                                             const std::filesystem::path& plan_file);

/// Completes `render --plan FILE --task I` and `merge --plan FILE` in `words` of a command line by
/// the plan; other command lines are unchanged. Throws `Error`: those of `read_plan`, and usage for
/// words that contradict the plan.
[[nodiscard]] std::vector<std::string> with_planned_words(std::vector<std::string> words);

/// Returns the requested task of `plan`, which is in `file`: by its index, or by "env:NAME", an
/// environment variable with the index. Throws `OptionError`.
[[nodiscard]] const PlanTask& find_task(const Plan& plan, const std::filesystem::path& file,
                                        const std::string& asked);

/// Returns the words after `bdpt render` that all tasks of `plan`, which is in `file`, share: the
/// scene and the options, without samples and files that are written.
[[nodiscard]] std::vector<std::string> shared_words(const Plan& plan,
                                                    const std::filesystem::path& file);

/// Planned identity of an image: complete or, as frames are planned without loading each, some of
/// its components.
struct PlannedIdentity {
    Identity identity;
    bool whole = true;
};

/// Returns the identity of image `image`. For a sequence it has the options, the build and the seed
/// of the image: the scene of each frame follows from these and from the files.
[[nodiscard]] PlannedIdentity planned_identity(const Plan& plan, std::size_t image);

/// Returns the difference of `planned` from `found`, as `difference()` of identities.
[[nodiscard]] std::optional<std::string> difference(const Identity& found,
                                                    const PlannedIdentity& planned);

/// Returns the components that all images of the sequence of `asked` share, given the identity of
/// one of them.
[[nodiscard]] Identity common_identity(const Identity& of_one, const RenderArguments& asked);

/// Returns a component "file: NAME" with the contents of each file of the scene of `asked`. Throws
/// `Error` (not_found, invalid_input).
[[nodiscard]] Identity identity_of_files(const RenderArguments& asked);

/// Texts of the files in lib/job/src/plan/engines.
namespace engine_texts {
[[nodiscard]] std::string_view submit_sh();
[[nodiscard]] std::string_view tasks_sbatch();
[[nodiscard]] std::string_view merge_sbatch();
[[nodiscard]] std::string_view kubernetes();
[[nodiscard]] std::string_view makefile();
}  // namespace engine_texts

/// A file by which an engine starts tasks.
struct EngineFile {
    std::string name;
    std::string text;  ///< a template has marks like \@COUNT\@ in place of values (docs/farm.md)
};

/// Returns the templates of the files of `engine`: `changed` are files of the user that replace
/// those of the same name. Throws `Error`: usage for other names, not_found for a missing file.
[[nodiscard]] std::vector<EngineFile> engine_templates(
    Engine engine, const std::vector<std::filesystem::path>& changed);

/// Returns `templates` with the values of `plan`, whose file is plan.json in `folder`, which is
/// absolute.
[[nodiscard]] std::vector<EngineFile> engine_files(std::vector<EngineFile> templates,
                                                   const Plan& plan,
                                                   const std::filesystem::path& folder);

/// Returns the command that the user types to start the tasks.
[[nodiscard]] std::string start_command(Engine engine, const std::filesystem::path& folder);

/// Throws `Error` (output), before anything is loaded, for a folder that could not be written.
void check_plan_folder(const std::filesystem::path& folder);

/// Writes `plan` as plan.json into `folder`, which is created if necessary. Before that it writes
/// `files`, and calls `write_rates` with the file for rates, so that a plan is always complete.
/// `write_rates` is not called for plans without rates. Throws `Error`: output, also if another
/// plan exists and is not to be replaced; invalid_input for a symbolic link in a file's place.
void write_plan(const std::filesystem::path& folder, const Plan& plan,
                const std::vector<EngineFile>& files,
                const std::function<void(const std::filesystem::path&)>& write_rates,
                ExistingPlan existing);

}  // namespace bdpt::job
