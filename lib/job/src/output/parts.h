#pragma once

#include <bdpt/io/denoise.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_result.h>
#include <bdpt/part/sample_set.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/image_arguments.h"
#include "options/render_arguments.h"
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

/// Tells whether the user wants a checkpoint now.
enum class Checkpoint : std::uint8_t { when_due, now };

/// Reads the part that a render continues, and writes it at intervals and at the end.
class PartKeeper {
public:
    /// `planned`: identity of the image by the plan of `choice`, if there is a plan. Throws `Error`
    /// (invalid_input) if the file exists, is to be continued, and is no intact part.
    PartKeeper(PartChoice choice, std::optional<PlannedIdentity> planned, Console& console);

    /// Tests whether nothing is left to do: the file has all of these samples, and satisfies the
    /// plan.
    [[nodiscard]] bool is_complete(SampleRange samples) const;
    /// Tests whether pixels of the part to continue have different numbers of samples; nullopt if
    /// the render begins.
    [[nodiscard]] std::optional<bool> has_rates() const;
    /// Returns the part to continue; without samples if the render begins. `identity` is that of
    /// the render, `notes` are written into the file. Throws `Error` (invalid_input) if the file is
    /// a part of another render, or the plan is one of another.
    [[nodiscard]] RenderResult start(const Identity& identity, io::PartNotes notes);
    /// Writes a checkpoint if the last one is old enough; called between passes. A failure is only
    /// a warning, as there will be another checkpoint.
    void after_pass(const RenderResult& part, Checkpoint checkpoint);
    /// Writes the samples that are not in the file yet. Throws `Error` (output).
    void finish(const RenderResult& part);

private:
    using Clock = std::chrono::steady_clock;

    void write(const RenderResult& part);

    PartChoice choice_;
    Console& console_;
    std::optional<PlannedIdentity> planned_;
    std::optional<io::PartInfo> there_;
    io::PartNotes notes_;
    io::OldPart old_;
    SampleSet written_;
    Clock::time_point last_ = Clock::now();
    std::chrono::duration<double> interval_;
};

}  // namespace bdpt::job
