#pragma once

#include <bdpt/io/exr.h>
#include <bdpt/io/gltf.h>
#include <bdpt/isa.h>
#include <bdpt/render.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/arguments.h"
#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/groups/environment_arguments.h"
#include "options/groups/film_arguments.h"
#include "options/groups/fog_arguments.h"
#include "options/groups/ground_arguments.h"
#include "options/groups/lens_arguments.h"
#include "options/groups/rates_arguments.h"
#include "options/groups/scene_arguments.h"
#include "options/groups/sequence_arguments.h"
#include "options/groups/strategy_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/groups/volume_arguments.h"
#include "options/part_arguments.h"
#include "options/values/view.h"
#include "options/values/viewer_address.h"
#include "terminal/console.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say, as they were given.
struct RenderWords {
    std::string file;
    std::vector<std::string> outputs;
    std::optional<std::int64_t> samples;
    std::optional<std::string> time;
    std::optional<std::string> noise;
    std::optional<std::string> size;
    TransportWords transport;
    RatesWords rates;
    std::string sampler = "sobol";
    std::optional<std::string> camera;
    std::optional<std::string> look_at;
    std::optional<std::string> from;
    std::optional<double> fov;  // [deg]
    LensWords lens;
    SceneWords scene;
    std::optional<std::string> environment;
    std::string texture_filter = "bilinear";
    EnvironmentWords environment_change;
    FogWords fog;
    VolumeWords volume;
    DisplayWords display;
    DenoiseWords denoise;
    int threads = 0;
    std::string isa = "native";
    FilmWords film;
    GroundWords ground;
    std::optional<std::string> stats;
    bool profile = false;
    StrategyWords strategies;
    PartWords part;
    SequenceWords sequence;
    bool tiled = false;
    std::string seed = "0";
    bool half = false;
    bool single = false;
    std::optional<std::string> viewer;
    bool quiet = false;
    bool json = false;
};

/// The same, understood and checked.
struct RenderArguments {
    std::filesystem::path file;
    std::vector<std::filesystem::path> outputs;
    Goal goal;
    std::optional<Size> size;
    RenderOptions options;              ///< without size and sample range
    std::optional<std::string> camera;  ///< name, index or "auto"
    ViewOverrides view;
    LensWords lens;  ///< checked
    Isa isa = Isa::native;
    io::GltfOptions scene;                   ///< what of the file is rendered
    io::MemoryLimit memory;                  ///< for scene and film
    std::optional<std::string> environment;  ///< file, "none" or "default"
    TextureFilter texture_filter = TextureFilter::bilinear;
    EnvironmentChange environment_change;  ///< of whichever environment it is
    std::optional<MediumDesc> fog;         ///< around all bodies, if any
    std::optional<VolumeChoice> volume;    ///< in the scene, if any
    DisplayArguments display;
    std::optional<DenoiseArguments> denoise;  ///< if images are to be denoised
    io::ExrChannelType channel_type = io::ExrChannelType::single_float;
    io::ExrStorage storage = io::ExrStorage::scanlines;
    std::optional<std::filesystem::path> stats;  ///< where numbers about the render go
    Profiling profiling = Profiling::off;
    std::optional<StrategyFiles> strategies;      ///< where images of strategies go
    std::optional<PartChoice> part;               ///< what the render goes on with
    SampleRange samples;                          ///< of each pixel
    std::optional<RatesChoice> rates;             ///< if pixels take different numbers of them
    std::optional<Sequence> sequence;             ///< if there are several images
    std::optional<SequenceView> sequence_view{};  ///< which of them this is
    std::optional<DisplayAddress> viewer;         ///< of the viewer that shows the render
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Describes the options of `bdpt render` to the parser, which will store into `words`.
void add_render_options(CLI::App& command, RenderWords& words);

/// Of these, those that say which image is made and where it goes, however many processes render
/// it.
void add_plannable_options(CLI::App& command, RenderWords& words);

/// Of those, what is rendered and through which lens: for other commands, too.
void add_view_options(CLI::App& command, RenderWords& words);

/// The noise of --noise. Throws `OptionError`.
[[nodiscard]] std::optional<double> to_noise(const std::optional<std::string>& word);

/// --seed and --threads.
void add_seed_and_threads(CLI::App& command, RenderWords& words, const char* group);

/// Throws `Error` (usage) that names the option and the value.
[[nodiscard]] RenderArguments understand(const RenderWords& words);

}  // namespace bdpt::app
