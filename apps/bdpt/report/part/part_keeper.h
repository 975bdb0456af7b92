#pragma once

#include <bdpt/io/part_file.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/render_part.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "options/part_arguments.h"
#include "plan/planned_identity.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Whether the user wants a checkpoint now.
enum class Checkpoint : std::uint8_t { when_due, now };

/// Reads the part that a render goes on with, and writes it in good time and at the end.
class PartKeeper {
public:
    /// `planned`: what the plan of `choice` says of the image, if there is a plan. Throws `Error`
    /// (invalid_input) when the file is there, is to be gone on with, and is no whole part.
    PartKeeper(PartChoice choice, std::optional<PlannedIdentity> planned, Console& console);

    /// Is nothing left to do: are all of these samples in the file, as the plan wants them?
    [[nodiscard]] bool is_complete(SampleRange samples) const;
    /// The part to go on with; without samples when the render begins. `identity` is that of the
    /// render, `notes` go into the file. Throws `Error` (invalid_input) when the file is a part of
    /// another render, or the plan one of another.
    [[nodiscard]] RenderPart start(const Identity& identity, io::PartNotes notes);
    /// Between passes: writes a checkpoint when there was none for a while. That it cannot be
    /// written is a warning; there will be another one.
    void after_pass(const RenderPart& part, Checkpoint checkpoint);
    /// Writes what is not in the file yet. Throws `Error` (output).
    void finish(const RenderPart& part);

private:
    using Clock = std::chrono::steady_clock;

    void write(const RenderPart& part);

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

}  // namespace bdpt::app
