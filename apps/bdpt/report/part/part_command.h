#pragma once

#include <bdpt/part/sample_set.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::app {

/// Of the words of a command line those that say what is rendered: without files that are written,
/// numbers of samples, and what changes no bit.
[[nodiscard]] std::vector<std::string> render_words(const std::vector<std::string>& words);

/// Commands, for a shell, that render `samples`, each into a file of its own in `folder`; empty
/// without `words`.
[[nodiscard]] std::vector<std::string> commands_for(const std::vector<std::string>& words,
                                                    const SampleSet& samples,
                                                    const std::filesystem::path& folder);

/// Commands, for a shell, that render `tasks` of the plan in `file`.
[[nodiscard]] std::vector<std::string> commands_for(const std::filesystem::path& file,
                                                    const std::vector<std::size_t>& tasks);

}  // namespace bdpt::app
