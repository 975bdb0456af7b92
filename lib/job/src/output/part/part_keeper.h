#pragma once

#include <bdpt/io/part_file.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_result.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "messages/console.h"
#include "options/part_arguments.h"
#include "plan/planned_tasks.h"

namespace bdpt::job {

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
