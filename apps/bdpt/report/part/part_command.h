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

/// "0:64,128:192" of ranges, as far as a message has room for them.
[[nodiscard]] std::string ranges_text(const SampleSet& samples);

/// "; to render them: " and commands, for a shell, that render `samples`, each into a file of its
/// own in `folder`; as far as a message has room for them. Empty without `words` or samples.
[[nodiscard]] std::string commands_text(const std::vector<std::string>& words,
                                        const SampleSet& samples,
                                        const std::filesystem::path& folder);

/// The same of commands that render `tasks` of the plan in `file`.
[[nodiscard]] std::string commands_text(const std::filesystem::path& file,
                                        const std::vector<std::size_t>& tasks);

}  // namespace bdpt::app
