#pragma once

#include <nanobind/nanobind.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/render_arguments.h"

namespace bdpt::python {

/// Keyword arguments are the options of the command: size=(640, 480) is "--size=640x480",
/// look_at=(0, 1, 0) is "--look-at=0,1,0", from_=... is "--from=...", True is a flag.
using Words = std::vector<std::string>;

/// Which call an option belongs to.
enum class Call { load, render, save };

/// The words for `options`. Throws `Error` (usage) for options that do not belong to `call`, saying
/// where they belong.
[[nodiscard]] Words words_of(const nanobind::kwargs& options, Call call);

/// Does one of `words` choose a camera, or change its place or its lens?
[[nodiscard]] bool change_view(const Words& words);

/// The words of load() and those of render(), which take the place of those that they cannot be
/// combined with: another view of the same scene.
[[nodiscard]] Words combined(const Words& of_load, const Words& of_render);

/// What `words` of load() and render() mean, by the parser of the command.
[[nodiscard]] app::RenderArguments understand_render(const Words& words);

/// How a file is written.
struct SaveArguments {
    app::DisplayArguments display{};
    std::optional<app::DenoiseArguments> denoise{};
    app::ExrFormat exr{};
};

[[nodiscard]] SaveArguments understand_save(const Words& words);

/// `head`, the options of `call` as keywords with their types, and `result`, as Python declares
/// functions: "def load(file: str, *", "Scene".
[[nodiscard]] std::string declaration(std::string_view head, Call call, std::string_view result);

/// `text`, and the options of `call`, each with its values and what it does, as a docstring.
[[nodiscard]] std::string documentation(std::string_view text, Call call);

}  // namespace bdpt::python
