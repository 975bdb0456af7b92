#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/io/image_metadata.h>
#include <bdpt/render.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"
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

/// Time of a run by phase [s].
struct TimeSplit {
    double load = 0.0;    ///< reading files
    double build = 0.0;   ///< acceleration structures and other preparation of the scene
    double choose = 0.0;  ///< the pilot of --integrator auto
    double render = 0.0;
    double write = 0.0;  ///< writing images
};

/// Returns estimate_noise() of a film; null if it is unknown.
[[nodiscard]] nlohmann::ordered_json noise_json(double noise);

/// Returns the statistics of a render, for programs.
[[nodiscard]] nlohmann::ordered_json stats_json(const RenderResult& result, const TimeSplit& time);

/// Writes `stats` atomically. Throws `Error` (output).
void write_stats_file(const std::filesystem::path& file, const nlohmann::ordered_json& stats);

/// Returns all settings that the image depends on.
[[nodiscard]] nlohmann::ordered_json make_settings(const RenderArguments& arguments,
                                                   const PreparedScene& stage);

/// Returns the metadata of image files; samples and times are filled in after rendering.
[[nodiscard]] io::ImageMetadata make_metadata(const RenderArguments& arguments,
                                              const PreparedScene& stage,
                                              const nlohmann::ordered_json& settings);

}  // namespace bdpt::app
