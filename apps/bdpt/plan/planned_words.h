#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace bdpt::app {

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

}  // namespace bdpt::app
