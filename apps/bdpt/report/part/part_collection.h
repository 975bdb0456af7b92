#pragma once

#include <bdpt/io/part_file.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/part_arguments.h"
#include "plan/plan.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Parts of one render, of which none has samples of another.
struct PartCollection {
    std::vector<io::PartInfo> parts;
    SampleSet samples;                ///< of all of them
    SampleSet goal;                   ///< that the render was to have, as far as is known
    std::vector<std::string> notes;   ///< on parts that bring nothing
    std::vector<std::string> faults;  ///< of files that may become readable, if that is waited for
    [[nodiscard]] SampleSet missing() const { return samples.missing(goal); }
};

/// The parts of `arguments`, all of one image of `plan` if there is one, which may be waited for
/// until all samples of the goal are there or the time is over. Whether they are is decided by what
/// is in the files alone. Files of a plan may be absent; when they are waited for, all may be, and
/// may be unreadable for a while. Throws `Error`: what `read_part_info` does, and invalid_input for
/// parts of different renders, or of another than the plan's, and for parts that overlap without
/// one being in the other.
[[nodiscard]] PartCollection collect_parts(const MergeArguments& arguments,
                                           const std::optional<Plan>& plan, Console& console);

}  // namespace bdpt::app
