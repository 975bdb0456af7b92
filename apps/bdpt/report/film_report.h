#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>

#include <string>
#include <vector>

#include "terminal/console.h"

namespace bdpt::app {

/// Warns of contributions that could not be added unchanged, if there were any.
void warn_of_defects(Console& console, const FilmDefects& defects);

/// Tests whether `image` is black although something is in it; `layers` has its alpha, if known.
[[nodiscard]] bool is_black(const Image& image, const std::vector<Layer>& layers);

/// Returns the warning about a black image of a scene that has lights.
[[nodiscard]] std::string black_image_text(const std::string& scene);

/// Reports the light that clamping removed from `image`, which is the developed `film`.
void report_clamp(Console& console, const Film& film, const Image& image);

}  // namespace bdpt::app
