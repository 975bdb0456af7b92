#pragma once

#include <bdpt/job.h>
#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/groups/image_arguments.h"
#include "options/render_arguments.h"

namespace bdpt::python {

/// Words of the command line for keyword arguments, which are the command's options: size=(640,
/// 480) is "--size=640x480", look_at=(0, 1, 0) is "--look-at=0,1,0", from_=... is "--from=...",
/// True is a flag.
using Words = std::vector<std::string>;

/// The Python call that an option belongs to.
enum class Call { load, render, save, run };

/// Returns the words for `options`. Throws `CallError` for options that do not belong to `call`,
/// saying where they belong, and for values of wrong types; `Error` (usage) for other wrong values.
[[nodiscard]] Words to_words(const nanobind::kwargs& options, Call call);

/// Sets `options` in `job`. Throws as `to_words`, but invalid_input for wrong values.
void set_options(RenderJob& job, const nanobind::kwargs& options);

/// Returns a message of the command with the keywords of Python for its options: "samples cannot be
/// combined with spp".
[[nodiscard]] std::string in_keywords(std::string_view message);

/// Returns the files that `options` name to be read.
[[nodiscard]] std::vector<std::filesystem::path> given_paths(const nanobind::kwargs& options,
                                                             Call call);

/// Tests whether one of `words` chooses a camera, or changes its position or its lens.
[[nodiscard]] bool change_view(const Words& words);

/// Returns `words` without those.
[[nodiscard]] Words without_view(Words words);

/// Returns the first of `words` that is no option of load() that a pickle, which may come from
/// anybody, may state; none if all are.
[[nodiscard]] std::optional<std::string> find_unsafe(const Words& words);

/// Combines the words of load() with those of render(), which replace the ones that they cannot be
/// combined with: another view of the same scene.
[[nodiscard]] Words combined(const Words& of_load, const Words& of_render);

/// Parses the `words` of load() and render().
[[nodiscard]] job::RenderArguments understand_render(const Words& words);

/// Options of save().
struct SaveArguments {
    job::DisplayArguments display{};
    job::DenoiseArguments denoise{};
    job::ExrFormat exr{};
};

[[nodiscard]] SaveArguments understand_save(const Words& words);

/// Returns a Python function declaration: `head`, the options of `call` as keywords with their
/// types, and `result`, such as "def load(file: str, *", "Scene".
[[nodiscard]] std::string declaration(std::string_view head, Call call, std::string_view result);

/// Returns a docstring: `text`, and the options of `call`, each with its values and its effect.
[[nodiscard]] std::string documentation(std::string_view text, Call call);

}  // namespace bdpt::python
