#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/io/write_image.h>
#include <bdpt/isa.h>
#include <bdpt/medium_desc.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/image_arguments.h"
#include "options/groups/sequence_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/groups/view_arguments.h"
#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

/// Treatment of an existing part file by the render that would write it.
enum class ExistingPart : std::uint8_t { go_on, restart };

/// The part file that a render continues.
struct PartChoice {
    std::filesystem::path file{};
    ExistingPart existing = ExistingPart::go_on;
    std::optional<std::filesystem::path> plan{};  ///< plan that the render must belong to
    std::string task{};  ///< task in the plan: its number, or where to find it
};

/// Adds --part, --restart, --plan and --task.
void add_part_options(OptionList& options, PartChoice& part);

/// Returns `part` if --part is given. Throws `OptionError`.
[[nodiscard]] std::optional<PartChoice> checked(const PartChoice& part, const OptionList& options);

/// Storage of .exr files.
struct ExrFormat {
    io::ExrChannelType channel_type = io::ExrChannelType::single_float;
    io::ExrStorage storage = io::ExrStorage::scanlines;
};

/// Adds --half.
void add_half_option(OptionList& options, ExrFormat& exr);
/// Adds --tiled.
void add_tiled_option(OptionList& options, ExrFormat& exr);

/// Output of a command on its streams.
struct Printed {
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Adds -q,--quiet; `help` says what is still printed.
void add_quiet_option(OptionList& options, Printed& printed,
                      std::string help = "Print errors only");
/// Adds --json; `help` says what is printed.
void add_json_option(OptionList& options, Printed& printed, std::string help);

/// Treatment of a merge with missing samples.
enum class Incomplete : std::uint8_t { refuse, write };

/// Arguments of `bdpt merge`.
struct MergeArguments {
    std::vector<std::filesystem::path> parts{};
    std::vector<std::filesystem::path> outputs{};
    StrategyFiles strategies{};
    std::optional<std::filesystem::path> plan{};  ///< plan of the parts
    std::size_t image = 0;                        ///< index in the plan
    std::optional<SampleSet> goal{};              ///< goal of the plan for each image
    std::optional<double> wait{};                 ///< time to wait for parts [s]; may be infinite
    std::optional<std::int64_t> samples{};        ///< requested samples per pixel of the render
    std::optional<double> noise{};                ///< requested noise, as by estimate_noise()
    Incomplete incomplete = Incomplete::refuse;
    DisplayArguments display{};
    DenoiseArguments denoise{};
    ExrFormat exr{};
    Printed printed{};
};

/// Tests whether `file` is named as a part of a render: NAME.part.exr.
[[nodiscard]] bool is_part_name(const std::filesystem::path& file);

/// Adds the options of `bdpt merge`.
void add_merge_options(OptionList& options, MergeArguments& arguments);

/// Returns the arguments. Throws `OptionError` for incompatible options.
[[nodiscard]] MergeArguments checked(const MergeArguments& arguments, const OptionList& options);

/// Source of sample rates.
struct RatesChoice {
    std::optional<std::filesystem::path> file{};  ///< none: a pilot measures them
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
    std::optional<std::string> environment{};  ///< a file, or one of `named_environments`
    TextureFilter texture_filter = TextureFilter::bilinear;
    ContactKind contacts = ContactKind::automatic;
    EnvironmentChange environment_change{};  ///< applied to whichever environment it is
    std::optional<MediumDesc> fog{};         ///< around all bodies, if any
    std::optional<VolumeChoice> volume{};    ///< in the scene, if any
    DisplayArguments display{};
    /// Exposure of a white card [EV], if the light was metered.
    std::optional<float> light_exposure{};
    DenoiseArguments denoise{};
    /// Layers of the film for files for screens alone: they guide the denoiser, or darken the
    /// ground. No file has them.
    std::vector<Aov> screen_aovs{};
    bool may_add_ground = false;  ///< if the scene gets the light of objects without lights
    ExrFormat exr{};
    std::optional<std::filesystem::path> stats{};  ///< file for statistics of the render
    std::optional<StrategyFiles> strategies{};     ///< files of strategy images
    std::optional<PartChoice> part{};              ///< part that the render continues
    SampleRange samples{};                         ///< per pixel
    std::optional<RatesChoice> rates{};  ///< set if pixels take different numbers of samples
    bool may_adapt = false;              ///< the pilot of the integrator may choose rates
    /// No option sets a limit of the render of one image: a denoised picture gets fewer samples.
    bool may_take_few = false;
    std::optional<std::filesystem::path> saved_rates{};  ///< .exr or .png for the rates
    std::optional<Sequence> sequence{};                  ///< set if there are several images
    std::optional<SequenceView> sequence_view{};         ///< the image of the sequence that this is
    std::optional<NetworkAddress> viewer{};              ///< viewer that shows the render
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
        auto sheet = arguments.strategies->sheet();
        visit("--strategies", arguments.strategies->layers);
        visit("--strategies", sheet);
    }
    if (arguments.part) {
        visit("--part", arguments.part->file);
    }
    if (arguments.saved_rates) {
        visit("--save-rates", *arguments.saved_rates);
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
    Ground ground = Ground::automatic;
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

/// Words of --env; others are paths of files.
inline constexpr std::array<std::string_view, 4> named_environments{"default", "object", "studio",
                                                                    "none"};

/// Tests whether --env `environment` is the path of a file; else it is a word.
[[nodiscard]] bool is_file_of_environment(const std::string& environment);

/// System that starts the tasks of a plan.
enum class Engine : std::uint8_t { slurm, kubernetes, make };

/// Treatment of an existing plan.
enum class ExistingPlan : std::uint8_t { must_be_equal, replace };

/// Arguments of `bdpt plan`.
struct PlanArguments {
    RenderArguments render{};
    std::vector<std::string> render_options{};  ///< as words, without files, samples and threads
    std::vector<std::string> merge_options{};   ///< as words, without files
    std::optional<std::int64_t> parts{};
    double minutes = 0.0;  ///< maximum time of a task, without `parts`
    Engine engine = Engine::make;
    std::vector<std::filesystem::path> templates{};  ///< in place of files of the engine
    std::filesystem::path folder{};
    ExistingPlan existing = ExistingPlan::must_be_equal;
};

/// Names, such as "--size", of the options that a plan may have for the commands of its tasks. They
/// exclude options that name files (which the plan stores separately), loaded code or machines.
struct PlannableOptions {
    std::vector<std::string> render;
    std::vector<std::string> merge;
};
[[nodiscard]] PlannableOptions plannable_options();

/// Options of `bdpt plan`, as given.
struct PlanRequest {
    RenderRequest render{};
    PlanArguments arguments{};
};

/// Adds the options of `bdpt plan`.
void add_plan_options(OptionList& options, PlanRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] PlanArguments checked(const PlanRequest& request, const OptionList& options);

}  // namespace bdpt::job
