#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

// A job is a JSON file equivalent to a command line: its members are the options of `bdpt render`
// (`OptionUses::job`), by their names with '_' for '-', and "file", the scene. It loads no code.
// Paths in it are relative to its folder.

/// Value of "bdpt_job" in jobs. It is incremented with every change that older programs would
/// misread.
inline constexpr int job_format = 1;

/// Tests whether `file` is named as a job: .json.
[[nodiscard]] bool is_job(const std::filesystem::path& file);

/// Stores the options of the job in `file` into `options`, except those that were already given;
/// the job replaces the given scene. Throws `Error`: not_found, and invalid_input that names the
/// place in the file.
void load_job(const std::filesystem::path& file, OptionList& options);

/// Returns the given `options` as a job to be written to `file`.
[[nodiscard]] std::string job_text(const OptionList& options, const std::filesystem::path& file);

/// Returns the JSON schema [draft 2020-12] of jobs with `options`.
[[nodiscard]] std::string job_schema(const OptionList& options);

/// Returns the given `options` as words of a command line.
[[nodiscard]] std::vector<std::string> to_words(const OptionList& options);

}  // namespace bdpt::app
