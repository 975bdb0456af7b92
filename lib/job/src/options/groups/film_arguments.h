#pragma once

#include <bdpt/aov.h>
#include <bdpt/options/filter_options.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Parses "gaussian" or "gaussian:2"; the radius [pixels] is in the range of `FilterOptions`.
[[nodiscard]] std::optional<FilterOptions> parse_filter(std::string_view text);

/// Parses "albedo,normal,depth,position,samples,variance,alpha,object,material", or some of them.
[[nodiscard]] std::optional<AovSet> parse_aovs(std::string_view text);

/// Parses "x0,y0,x1,y1", whole numbers; x0 < x1 and y0 < y1.
[[nodiscard]] std::optional<PixelRect> parse_crop(std::string_view text);

// Value types of options with these parsers.
[[nodiscard]] ValueType<FilterOptions> filter_type();
[[nodiscard]] ValueType<AovSet> aov_type();
[[nodiscard]] ValueType<PixelRect> crop_type();

/// Kinds of ground below the scene.
enum class Ground : std::uint8_t { none, shadow };

/// Adds --ground.
void add_ground_option(OptionList& options, Ground& ground);

/// Returns `film` with the layer of the shadow on the ground, if requested. Throws `OptionError`
/// for options that are incompatible with it.
[[nodiscard]] FilmOptions with_ground(Ground ground, FilmOptions film, const OptionList& options);

/// Returns the memory of the film of a render of `size`, with its layers and the image that it is
/// developed to [bytes].
[[nodiscard]] std::uint64_t film_bytes(const RenderOptions& options, const Size& size);

/// Returns the memory that Open Image Denoise takes for a render of `size` [bytes].
[[nodiscard]] std::uint64_t denoiser_bytes(const RenderOptions& options, const Size& size);

// Options of the command that are fields of `RenderOptions`, generated from the list in
// <bdpt/options/option_fields.h>: a field with a help text there is an option here.

/// Adds the fields of a group, such as `FilmOptions`.
template <typename Group>
void add_fields(OptionList& options, Group& group);

/// Adds the fields `names`, such as "light_samples", of all groups.
void add_fields(OptionList& options, RenderOptions& render,
                std::span<const std::string_view> names);

}  // namespace bdpt::job
