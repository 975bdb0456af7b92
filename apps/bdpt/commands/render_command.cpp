#include "commands/render_command.h"

#include <bdpt/framing.h>
#include <bdpt/io/image_cache.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands/render_view.h"
#include "options/values/orbit.h"
#include "options/values/output_files.h"
#include "report/denoised.h"
#include "report/part/part_keeper.h"
#include "report/render_files.h"
#include "report/viewer/display.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

/// Of a task that has been done before.
void report_complete(Console& console, const RenderArguments& arguments)
{
    const std::int64_t samples = arguments.samples.end - arguments.samples.begin;
    console.note(fmt::format("{}: has all samples of the task", arguments.part->file.string()));
    console.event("done", {{"samples", samples},
                           {"seconds", 0.0},
                           {"outputs", ordered_json::array()},
                           {"exposure", nullptr},
                           {"stopped_by", nullptr}});
}

/// Images are decoded once, if the file is loaded for several frames.
RenderArguments with_cache(RenderArguments arguments)
{
    if (arguments.sequence && arguments.sequence->frames && arguments.sequence->orbit == 0) {
        arguments.scene.images = std::make_shared<io::ImageCache>(image_cache_bytes(arguments));
    }
    return arguments;
}

PreparedScene load(const RenderArguments& arguments, Console& console)
{
    PreparedScene stage = prepare_within_memory(arguments, console);
    console.end_progress();
    return stage;
}

/// The camera of `image`, which goes around if that is asked for. `first` is the one that the scene
/// was loaded with.
Viewpoint viewpoint_of(const PreparedScene& stage, const Viewpoint& first,
                       const RenderArguments& image)
{
    if (!image.sequence_view) {
        return first;
    }
    const SequenceView& view = *image.sequence_view;
    Viewpoint result = view.camera ? viewpoint(stage, *view.camera, image) : first;
    if (view.turn) {
        const Bounds& bounds = stage.scene.bounds();
        const Vec3 center =
            orbit_center(result.camera, image.view.look_at, 0.5f * (bounds.min + bounds.max));
        result.camera = orbited(std::move(result.camera), center, static_cast<float>(*view.turn));
    }
    return result;
}

}  // namespace

int run_render(const RenderArguments& typed, const std::vector<std::string>& words)
{
    const RenderArguments asked = with_cache(typed);
    check_patterns(asked);
    Console console(asked.format, asked.verbosity);
    Interrupt interrupt(
        {},
        [&console] {
            console.note("stopping after the pass in flight; interrupt again to end at once");
        },
        asked.part ? UserSignal::checkpoint : UserSignal::default_action);
    if (asked.sequence && asked.sequence->frames && !asked.display.exposure &&
        std::any_of(asked.outputs.begin(), asked.outputs.end(),
                    [](const auto& output) { return has_extension(output, ".png"); })) {
        console.warning(
            "each .png file has an exposure of its own, so that frames may flicker; "
            "--exposure EV gives all the same");
    }
    std::optional<PreparedScene> stage;
    if (asked.sequence && asked.sequence->cameras == SequenceCameras::all) {
        stage = load(asked, console);
    }
    const std::vector<SequenceView> views =
        views_of(asked, stage ? camera_names(*stage) : std::vector<std::string>());
    for (const SequenceView& view : views) {
        static_cast<void>(check_files(arguments_of(asked, view)));
    }
    std::optional<Display> display;
    if (asked.viewer) {
        display.emplace(*asked.viewer, console);
    }
    const std::optional<io::Denoiser> denoiser =
        open_denoiser(asked.denoise, asked.outputs, asked.options.system.threads);
    std::optional<double> time = asked.scene.time;
    std::optional<Viewpoint> first;
    for (const SequenceView& view : views) {
        if (interrupt.signal()) {
            break;
        }
        const RenderArguments image = arguments_of(asked, view);
        console.begin_image(label_of(image));
        interrupt.set_temporaries(temporary_paths(check_files(image)));
        std::optional<PartKeeper> keeper;
        if (image.part) {
            keeper.emplace(*image.part, console);
            if (keeper->is_complete(image.samples) && image.outputs.empty()) {
                report_complete(console, image);
                continue;
            }
        }
        if (!stage || time != image.scene.time) {
            stage.reset();  // first, or there would be two in memory
            first.reset();
            stage = load(image, console);
            time = image.scene.time;
        }
        if (!first) {
            first = Viewpoint{.camera = stage->camera, .size = stage->size};
        }
        Viewpoint seen = viewpoint_of(*stage, *first, image);
        stage->camera = std::move(seen.camera);
        stage->size = seen.size;
        render_view(image, *stage, keeper,
                    {console, interrupt, display ? &*display : nullptr,
                     denoiser ? &*denoiser : nullptr, words_of(words, view)});
        stage->load_seconds = 0.0;
        stage->build_seconds = 0.0;
    }
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : 0;
}

}  // namespace bdpt::app
