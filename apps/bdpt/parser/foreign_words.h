#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "options/option_list.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Returns what to type in place of `word`, an option that a command with these `options` does not
/// have but other renderers and image tools do: "use --size WxH" for "--width". None: not known.
[[nodiscard]] std::optional<std::string> advice_for_option(std::string_view word,
                                                           const OptionList& options);

/// Returns the command of ours for the `word` of another program, "compare" for "diff"; none: not
/// known.
[[nodiscard]] std::optional<std::string_view> command_for(std::string_view word);

/// Throws `OptionError` if `words`, the options of a command as typed, contain a long option with a
/// single dash, like "-output" or "-resize": the parser would take its letters for short options.
void check_dashes(const std::vector<std::string>& words, const OptionList& options);

/// Throws `OptionError` if `word`, one of several scenes, is clearly something else: an image,
/// where outputs are not named, a number, or NAME=VALUE.
void check_scene_word(const std::string& word, const OptionList& options);

}  // namespace bdpt::app
