#pragma once

#include <bdpt/types.h>

#include <string>

namespace bdpt::app {

/// Of fog, and of volumes where their density is 1 [1/m].
constexpr float most_extinction = 1e6f;

/// The value of `option`: three numbers of [0, `most`], or one for all channels. Throws
/// `OptionError` that names `expected`.
[[nodiscard]] Rgb color_of(const char* option, const std::string& text, float most,
                           const std::string& expected);

/// The value of `option`: what a medium scatters, in [0, 1]. Throws `OptionError`.
[[nodiscard]] Rgb albedo_of(const char* option, const std::string& text);

/// The value of `option`: g of Henyey and Greenstein. Throws `OptionError`.
[[nodiscard]] float anisotropy_of(const char* option, double value);

}  // namespace bdpt::app
