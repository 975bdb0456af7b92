#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/memory_budget.h>
#include <bdpt/isa.h>
#include <bdpt/medium_desc.h>
#include <bdpt/render.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/arguments.h"
#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/groups/environment_arguments.h"
#include "options/groups/film_arguments.h"
#include "options/groups/lens_arguments.h"
#include "options/groups/medium_arguments.h"
#include "options/groups/sequence_arguments.h"
#include "options/groups/strategy_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/option_list.h"
#include "options/part_arguments.h"
#include "options/values/view.h"
#include "options/values/viewer_address.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Where rates of samples come from, and where they go.
struct RatesChoice {
    std::optional<std::filesystem::path> file{};   ///< none: a pilot finds them
    std::optional<std::filesystem::path> saved{};  ///< .exr or .png
};

/// How metadata calls the files of a render.
enum class PathNames : std::uint8_t {
    files,  ///< without their folders, which are nobody else's business
    paths,  ///< as they were given
};

/// What `bdpt render` is to do.
struct RenderArguments {
    std::filesystem::path file{};
    std::vector<std::filesystem::path> outputs{};
    Goal goal{};
    std::optional<Size> size{};
    RenderOptions options{};              ///< without size and sample range
    std::optional<std::string> camera{};  ///< name, index or "auto"
    ViewOverrides view{};
    LensChoice lens{};
    Isa isa = Isa::native;
    io::GltfOptions scene{};                   ///< what of the file is rendered
    io::MemoryLimit memory{};                  ///< for scene and film
    std::optional<std::string> environment{};  ///< a file, or "none", "default" or "studio"
    TextureFilter texture_filter = TextureFilter::bilinear;
    EnvironmentChange environment_change{};  ///< of whichever environment it is
    std::optional<MediumDesc> fog{};         ///< around all bodies, if any
    std::optional<VolumeChoice> volume{};    ///< in the scene, if any
    DisplayArguments display{};
    std::optional<float> light_exposure{};      ///< [EV] of a white card, if the light was metered
    std::optional<DenoiseArguments> denoise{};  ///< if images are to be denoised
    ExrFormat exr{};
    std::optional<std::filesystem::path> stats{};  ///< where numbers about the render go
    Profiling profiling = Profiling::off;
    std::optional<StrategyFiles> strategies{};    ///< where images of strategies go
    std::optional<PartChoice> part{};             ///< what the render goes on with
    SampleRange samples{};                        ///< of each pixel
    std::optional<RatesChoice> rates{};           ///< if pixels take different numbers of them
    std::optional<Sequence> sequence{};           ///< if there are several images
    std::optional<SequenceView> sequence_view{};  ///< which of them this is
    std::optional<DisplayAddress> viewer{};       ///< of the viewer that shows the render
    Printed printed{};
    PathNames path_names = PathNames::files;  ///< in the metadata of images
};

/// The options of `bdpt render`, as they are given: `arguments`, and what is understood only when
/// all of them are known (`checked`).
struct RenderRequest {
    RenderArguments arguments{};
    std::optional<std::int64_t> spp{};
    std::optional<double> seconds{};
    std::optional<SampleRange> samples{};
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    PathsOnly only = PathsOnly::all;
    Ground ground = Ground::none;
    bool adaptive = false;
    MediumDesc fog{};
    VolumeChoice volume{};
    DenoiseArguments denoise{};
    RatesChoice rates{};
    StrategyFiles strategies{};
    PartChoice part{};
    Sequence sequence{};
    std::vector<std::filesystem::path> others{};  ///< scenes behind the first
    std::filesystem::path saved_job{};            ///< written in place of the render; empty: none
};

extern const char* const render_footer;
extern const char* const render_short_footer;

/// The options that people need first.
[[nodiscard]] std::vector<std::string_view> render_essentials();

/// Adds the options of `bdpt render`.
void add_render_options(OptionList& options, RenderRequest& request);

/// Of these, those that say which image is made and where it goes, however many processes render
/// it.
void add_plannable_options(OptionList& options, RenderRequest& request);

/// Of those, what is rendered and through which lens: for other commands, too.
void add_view_options(OptionList& options, RenderRequest& request);

/// Adds --size.
void add_size_option(OptionList& options, RenderRequest& request, std::string help);

/// Adds --time.
void add_time_option(OptionList& options, RenderRequest& request, std::string help);

/// The file of the scene, an argument without a name.
void add_scene_file(OptionList& options, RenderRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] RenderArguments checked(const RenderRequest& request, const OptionList& options);

/// What `words` say behind `bdpt render`. Throws `OptionError`.
[[nodiscard]] RenderArguments render_arguments(const std::vector<std::string>& words);

/// Is --env `environment` the path of a file? Else it is a word.
[[nodiscard]] bool is_file_of_environment(const std::string& environment);

}  // namespace bdpt::app
