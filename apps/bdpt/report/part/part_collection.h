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

}  // namespace bdpt::app
