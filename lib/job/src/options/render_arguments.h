#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/isa.h>
#include <bdpt/medium_desc.h>
#include <bdpt/render.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/camera_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/groups/film_arguments.h"
#include "options/groups/scene_arguments.h"
#include "options/groups/sequence_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/option_list.h"
#include "options/part_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Source and destination of sample rates.
struct RatesChoice {
    std::optional<std::filesystem::path> file{};   ///< none: a pilot measures them
    std::optional<std::filesystem::path> saved{};  ///< .exr or .png
};

/// Whether pixels take different numbers of samples.
enum class Adaptivity : std::uint8_t {
    automatic,  ///< if the integrator is automatic, and its pilot finds that it helps
    on,
    off,
};

/// Form of file paths in a render's metadata.
enum class PathNames : std::uint8_t {
    files,  ///< names without folders, for privacy
    paths,  ///< paths as given
};

/// A job that options came from, perhaps a stranger's.
struct JobSource {
    std::filesystem::path file{};
    std::vector<std::string> outputs{};  ///< its options that name files to write: "--output", ...
    bool names_default = false;          ///< the default output has the name of its scene
};

/// Arguments of `bdpt render`.
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
    io::GltfOptions scene{};                   ///< selects the part of the file to render
    io::MemoryLimit memory{};                  ///< for scene and film
    std::optional<std::string> environment{};  ///< a file, or "none", "default" or "studio"
    TextureFilter texture_filter = TextureFilter::bilinear;
    ContactKind contacts = ContactKind::automatic;
    EnvironmentChange environment_change{};  ///< applied to whichever environment it is
    std::optional<MediumDesc> fog{};         ///< around all bodies, if any
    std::optional<VolumeChoice> volume{};    ///< in the scene, if any
    DisplayArguments display{};
    /// Exposure of a white card [EV], if the light was metered.
    std::optional<float> light_exposure{};
    DenoiseArguments denoise{};
    /// Layers of the film that only guide the denoiser: no file has them.
    std::vector<Aov> guides{};
    ExrFormat exr{};
    std::optional<std::filesystem::path> stats{};  ///< file for statistics of the render
    std::optional<StrategyFiles> strategies{};     ///< files of strategy images
    std::optional<PartChoice> part{};              ///< part that the render continues
    SampleRange samples{};                         ///< per pixel
    std::optional<RatesChoice> rates{};  ///< set if pixels take different numbers of samples
    bool may_adapt = false;              ///< the pilot of the integrator may choose rates
    std::optional<Sequence> sequence{};  ///< set if there are several images
    std::optional<SequenceView> sequence_view{};  ///< the image of the sequence that this is
    std::optional<NetworkAddress> viewer{};       ///< viewer that shows the render
    Printed printed{};
    PathNames path_names = PathNames::files;  ///< in the metadata of images
    std::optional<JobSource> job{};           ///< set if there is one
};

/// Calls `visit(option, file)` for each file that `arguments` write, with the option that names it:
/// images, then the files of strategies, part, rates and statistics.
template <typename Arguments, typename Visitor>
void for_each_written_file(Arguments& arguments, const Visitor& visit)
{
    for (auto& output : arguments.outputs) {
        visit("--output", output);
    }
    if (arguments.strategies && !arguments.strategies->layers.empty()) {
        visit("--strategies", arguments.strategies->layers);
        visit("--strategies", arguments.strategies->sheet);
    }
    if (arguments.part) {
        visit("--part", arguments.part->file);
    }
    if (arguments.rates && arguments.rates->saved) {
        visit("--save-rates", *arguments.rates->saved);
    }
    if (arguments.stats) {
        visit("--stats", *arguments.stats);
    }
}

/// Options of `bdpt render`, as given: `arguments`, and the options that are resolved when all of
/// them are known (`checked`).
struct RenderRequest {
    RenderArguments arguments{};
    std::optional<std::int64_t> spp{};
    std::optional<double> seconds{};
    std::optional<SampleRange> samples{};
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    PathsOnly only = PathsOnly::all;
    Ground ground = Ground::none;
    Adaptivity adaptive = Adaptivity::automatic;
    MediumDesc fog{};
    VolumeChoice volume{};
    RatesChoice rates{};
    StrategyFiles strategies{};
    PartChoice part{};
    Sequence sequence{};
    std::vector<std::filesystem::path> others{};  ///< further scenes after the first
    std::filesystem::path saved_job{};  ///< job to write instead of rendering; empty: none
};

/// Adds the options of `bdpt render`.
void add_render_options(OptionList& options, RenderRequest& request);

/// Adds the options of `bdpt render` that select the image and its files, independently of the
/// number of processes that render it.
void add_plannable_options(OptionList& options, RenderRequest& request);

/// Adds the options that select what is rendered and through which lens; used by other commands,
/// too.
void add_view_options(OptionList& options, RenderRequest& request);

/// Adds --size.
void add_size_option(OptionList& options, RenderRequest& request, std::string help);

/// Adds --time.
void add_time_option(OptionList& options, RenderRequest& request, std::string help);

/// Adds the file of the scene, a positional argument.
void add_scene_file(OptionList& options, RenderRequest& request);

/// The options of `bdpt render`, and the request that they store into.
struct RenderOptionList {
    RenderOptionList() { add_render_options(list, request); }
    RenderOptionList(const RenderOptionList&) = delete;
    RenderOptionList& operator=(const RenderOptionList&) = delete;

    RenderRequest request{};
    OptionList list{};
};

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] RenderArguments checked(const RenderRequest& request, const OptionList& options);

/// Parses `words` after `bdpt render`, as `give_words` takes them. Throws `OptionError`.
[[nodiscard]] RenderArguments render_arguments(const std::vector<std::string>& words);

/// Tests whether --env `environment` is the path of a file; else it is a word.
[[nodiscard]] bool is_file_of_environment(const std::string& environment);

}  // namespace bdpt::job
