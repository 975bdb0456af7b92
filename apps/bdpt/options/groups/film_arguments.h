#pragma once

#include <bdpt/aov.h>
#include <bdpt/filter_options.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say about the film, as they were given.
struct FilmWords {
    std::optional<std::string> filter;
    std::optional<std::string> aovs;
    std::optional<std::string> crop;
    std::optional<double> clamp;  // [nit]
};

/// "gaussian" or "gaussian:2"; the radius [pixels] is in the range of `FilterOptions`.
[[nodiscard]] std::optional<FilterOptions> parse_filter(std::string_view text);

/// "albedo,normal,depth,position,samples,variance,alpha,object,material", or some of them.
[[nodiscard]] std::optional<AovSet> parse_aovs(std::string_view text);

/// "x0,y0,x1,y1", whole numbers; x0 < x1 and y0 < y1.
[[nodiscard]] std::optional<PixelRect> parse_crop(std::string_view text);

[[nodiscard]] const char* filter_name(FilterKind kind);

void add_film_options(CLI::App& command, FilmWords& words);

/// `options` with what `words` say. Throws `Error` (usage) that names the option and the value.
[[nodiscard]] RenderOptions with_film(const FilmWords& words, RenderOptions options);

}  // namespace bdpt::app
