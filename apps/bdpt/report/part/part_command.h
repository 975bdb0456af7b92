#pragma once

#include <bdpt/part/sample_set.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace bdpt::app {

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

}  // namespace bdpt::app
