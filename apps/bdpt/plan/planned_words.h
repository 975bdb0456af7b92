#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace bdpt::app {

/// `words` of a command line, where `render --plan FILE --task I` and `merge --plan FILE` are
/// filled up with what the plan says; others stay as they are. Throws `Error`: what `read_plan`
/// does, and usage for words that say other things than the plan.
[[nodiscard]] std::vector<std::string> with_planned_words(std::vector<std::string> words);

/// The task of `plan`, which is in `file`, that is asked for: by its index, or by "env:NAME" where
/// that is in the environment. Throws `OptionError`.
[[nodiscard]] const PlanTask& task_of(const Plan& plan, const std::filesystem::path& file,
                                      const std::string& asked);

/// What comes behind `bdpt render` for all tasks of `plan`, which is in `file`: the scene and the
/// options, without samples and files that are written.
[[nodiscard]] std::vector<std::string> shared_words(const Plan& plan,
                                                    const std::filesystem::path& file);

}  // namespace bdpt::app
