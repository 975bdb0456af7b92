#pragma once

#include <bdpt/part/sample_set.h>

#include <filesystem>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace bdpt::app {

/// Of the words of a command line those that say what is rendered: without files that are written,
/// numbers of samples, and what changes no bit.
[[nodiscard]] std::vector<std::string> render_words(const std::vector<std::string>& words);

/// Commands, for a shell, that render `samples`, each into a file of its own in `folder`; empty
/// without `words`.
[[nodiscard]] std::vector<std::string> commands_for(const std::vector<std::string>& words,
                                                    const SampleSet& samples,
                                                    const std::filesystem::path& folder);

/// Commands, for a shell, of those tasks of `plan`, which is in `file`, that render some of
/// `samples`.
[[nodiscard]] std::vector<std::string> commands_for(const Plan& plan,
                                                    const std::filesystem::path& file,
                                                    const SampleSet& samples);

}  // namespace bdpt::app
