#pragma once

#include <bdpt/io/json_value.h>

#include <filesystem>
#include <string>
#include <vector>

#include "options/option_list.h"

namespace bdpt::job {

// A job is a JSON file equivalent to a command line: its members are the options of `bdpt render`
// that documents may state (`StatedIn`), by their names with '_' for '-', and "file", the scene.
// Paths in it are relative to its folder.

/// Value of "bdpt_job" in jobs. It is incremented with every change that older programs would
/// misread.
inline constexpr int job_format = 1;

/// Returns "light_samples" for --light-samples.
[[nodiscard]] std::string to_key(const Option& option);

/// Tests whether `file` is named as a job: .json.
[[nodiscard]] bool is_job(const std::filesystem::path& file);

/// Stores the options of the job in `file` into `options`, except those that were already given;
/// the job replaces the given scene. Throws `Error`: not_found, and invalid_input that names the
/// place in the file.
void load_job(const std::filesystem::path& file, OptionList& options);

/// The same for a job that was read from `file`.
void load_job(const io::JsonValue& job, const std::filesystem::path& file, OptionList& options);

/// Stores `members`, an object of options as in jobs, into `options`, replacing what was given;
/// null removes it. Options of `StatedIn::programs` may be among them; paths are relative to the
/// working directory. Throws `Error` (invalid_input).
void set_options(const io::JsonValue& members, OptionList& options);

/// Returns the given `options` as a job to be written to `file`.
[[nodiscard]] std::string job_text(const OptionList& options, const std::filesystem::path& file);

/// Returns the JSON schema [draft 2020-12] of jobs with `options`.
[[nodiscard]] std::string job_schema(const OptionList& options);

/// Returns the given `options` as words of a command line.
[[nodiscard]] std::vector<std::string> to_words(const OptionList& options);

/// Stores `words`, as `to_words` returns them, into `options`: "--spp=64", "--half", and arguments.
/// Throws `OptionError`.
void give_words(const std::vector<std::string>& words, OptionList& options);

}  // namespace bdpt::job
