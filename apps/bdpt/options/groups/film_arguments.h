#pragma once

#include <bdpt/aov.h>
#include <bdpt/options/filter_options.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <string_view>

#include "options/option_list.h"

namespace bdpt::app {

/// "gaussian" or "gaussian:2"; the radius [pixels] is in the range of `FilterOptions`.
[[nodiscard]] std::optional<FilterOptions> parse_filter(std::string_view text);

/// "albedo,normal,depth,position,samples,variance,alpha,object,material", or some of them.
[[nodiscard]] std::optional<AovSet> parse_aovs(std::string_view text);

/// "x0,y0,x1,y1", whole numbers; x0 < x1 and y0 < y1.
[[nodiscard]] std::optional<PixelRect> parse_crop(std::string_view text);

// These as values of options.
[[nodiscard]] ValueType<FilterOptions> filter_type();
[[nodiscard]] ValueType<AovSet> aov_type();
[[nodiscard]] ValueType<PixelRect> crop_type();

/// What the ground below the scene does.
enum class Ground : std::uint8_t { none, shadow };

/// Adds --ground.
void add_ground_option(OptionList& options, Ground& ground);

/// `film` with the layer of the shadow on the ground, if that is wanted. Throws `OptionError` for
/// options that do not go with it.
[[nodiscard]] FilmOptions with_ground(Ground ground, FilmOptions film, const OptionList& options);

}  // namespace bdpt::app
