#pragma once

#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/inspect.h>
#include <bdpt/io/display.h>
#include <bdpt/io/write_image.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/transport_arguments.h"
#include "options/output_files.h"
#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {

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

/// Checks, before anything is rendered, that files can be written. Throws `Error`: usage if one is
/// an input or one of `outputs`, output for a place where nothing can be written.
void check_strategy_files(const StrategyFiles& files, const FileSet& inputs,
                          const FileSet& outputs);

/// Writes the image with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the image. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

/// Writes rates as .exr, which --rates reads, or as .png in false colours: the number of samples of
/// each pixel. Throws `Error` (output).
void save_rates(const std::filesystem::path& file, const RenderOptions& options,
                const io::ImageMetadata& metadata);

/// Throws `Error` if the job of `arguments`, whose author may be a stranger, names files to write:
/// invalid_input for those that are not in its folder or below, output for those that exist and
/// were not written by bdpt.
void check_files_of_job(const RenderArguments& arguments);

/// Checks, before anything is rendered, that files can be written, and returns all of them. Throws
/// `Error`: usage for files that are named twice, are among `inputs` or have a type that bdpt does
/// not write, output for places where nothing can be written.
[[nodiscard]] std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                                             const FileSet& inputs);

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

/// Returns tables of the vertices and of the contributions of strategies, for people.
[[nodiscard]] std::string inspect_text(const InspectedSample& sample, const PixelSample& which,
                                       const DVec3& origin);

/// Returns the complete data of the sample, for programs.
[[nodiscard]] nlohmann::ordered_json inspect_json(const InspectedSample& sample,
                                                  const PixelSample& which, const DVec3& origin);

/// Draws six labelled spheres of directions: incident light and the BSDF, tone-mapped; the
/// zero-variance density (the product of the two over its integral), the densities of BSDF sampling
/// and of light sampling, and their mean with `light_samples` of the latter, as heat colours of one
/// scale of four decades.
[[nodiscard]] io::DisplayImage direction_sheet(const DirectionMaps& maps, int light_samples);

/// Returns the maps as layers of an EXR file beside the product: incident, scattering, bsdf_pdf,
/// light_pdf.
[[nodiscard]] std::vector<Layer> direction_layers(const DirectionMaps& maps);

}  // namespace bdpt::job
