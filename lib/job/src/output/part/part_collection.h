#pragma once

#include <bdpt/io/denoise.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_result.h>
#include <bdpt/part/sample_set.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/display_arguments.h"
#include "options/part_arguments.h"
#include "plan/plan.h"

namespace bdpt::job {

/// Returns the words of a command line that define what is rendered: without files that are
/// written, numbers of samples, and options that change no bit.
[[nodiscard]] std::vector<std::string> render_words(const std::vector<std::string>& words);

/// Returns "0:64,128:192" for ranges, truncated to fit a message.
[[nodiscard]] std::string ranges_text(const SampleSet& samples);

/// Returns "; to render them: " and shell commands that render `samples`, each into its own file in
/// `folder`; truncated to fit a message. Empty without `words` or samples.
[[nodiscard]] std::string commands_text(const std::vector<std::string>& words,
                                        const SampleSet& samples,
                                        const std::filesystem::path& folder);

/// Returns the same for commands that render `tasks` of the plan in `file`.
[[nodiscard]] std::string commands_text(const std::filesystem::path& file,
                                        const std::vector<std::size_t>& tasks);

/// Disjoint parts of one render.
struct PartCollection {
    std::vector<io::PartInfo> parts;
    SampleSet samples;                ///< samples of all parts
    SampleSet goal;                   ///< requested samples of the render, as far as known
    std::vector<std::string> notes;   ///< about parts that contribute nothing
    std::vector<std::string> faults;  ///< errors of files that may become readable later
    [[nodiscard]] SampleSet missing() const { return samples.missing(goal); }
};

/// Collects the parts of `arguments`, all of one image of `plan` if there is one, waiting on
/// request until all samples of the goal are there or the time is over. Only the files' contents
/// decide that. Files of a plan may be absent; when waiting, all files may be absent, and may be
/// unreadable for a while. Throws `Error`: those of `read_part_info`, and invalid_input for parts
/// of different renders, or of another than the plan's, and for parts that overlap without one
/// containing the other.
[[nodiscard]] PartCollection collect_parts(const MergeArguments& arguments,
                                           const std::optional<Plan>& plan, Console& console);

/// Returns the display options of images of parts like `part`: parts without the environment behind
/// them get the backdrop of their render, or that of `asked`. Throws `Error`
/// (invalid_input) for a backdrop behind parts that show the environment.
[[nodiscard]] DisplayArguments display_of_parts(const io::PartInfo& part, DisplayArguments asked);

/// Checks that files can be written, like `check_outputs` and `check_strategy_files`, and that no
/// file of an image is a part of any.
void check_merged_files(std::span<const MergeArguments> images);

/// Throws `Error` (invalid_input) if strategy images are requested but `part` has none.
void check_strategies(const MergeArguments& arguments, const io::PartInfo& part);

/// Returns all files that are written.
[[nodiscard]] std::vector<std::filesystem::path> merged_files(const MergeArguments& arguments);

/// Writes `part` to the files of `arguments`, images by `display`, denoised if there is a denoiser.
/// Returns the files that are denoised. Throws `Error` (output).
std::vector<std::filesystem::path> write_merged_files(const MergeArguments& arguments,
                                                      const DisplayArguments& display,
                                                      const io::Denoiser* denoiser,
                                                      const RenderResult& part,
                                                      io::PartNotes notes);

/// Throws `Error` (output) if the plan makes `arguments` replace a file that is not an image
/// written by bdpt: plans are not trusted.
void check_planned_outputs(const MergeArguments& arguments, const Plan& plan);

}  // namespace bdpt::job
