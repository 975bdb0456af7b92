#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

// A job is a JSON file that says what a command line says: its members are the options of
// `bdpt render` (`OptionUses::job`), by their names with '_' for '-', and "file", the scene. It
// loads no code. Paths in it are relative to its folder.

/// The "bdpt_job" of jobs. It grows with every change that older programs would misread.
inline constexpr int job_format = 1;

/// Is `file` named as a job: .json?
[[nodiscard]] bool is_job(const std::filesystem::path& file);

/// Gives `options` what the job in `file` says, but for options that were given already, and stores
/// all of it; the job takes the place of the scene that was given. Throws `Error`: not_found, and
/// invalid_input that names the place in the file.
void load_job(const std::filesystem::path& file, OptionList& options);

/// What was given to `options` as a job that is written to `file`.
[[nodiscard]] std::string job_text(const OptionList& options, const std::filesystem::path& file);

/// What jobs of `options` may have, as a JSON schema [draft 2020-12].
[[nodiscard]] std::string job_schema(const OptionList& options);

/// What was given to `options`, as words of a command line.
[[nodiscard]] std::vector<std::string> words_of(const OptionList& options);

}  // namespace bdpt::app
