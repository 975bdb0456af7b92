#include "commands/render_command.h"

#include <fmt/core.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "commands/render_view.h"
#include "options/output_files.h"
#include "report/part_keeper.h"
#include "report/render_files.h"
#include "stage/memory_budget.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
namespace {

/// `arguments`, whose loading shows on the console how far it is.
RenderArguments with_progress(RenderArguments arguments, Console& console)
{
    const auto start = std::chrono::steady_clock::now();
    arguments.scene.on_progress = [&console, start](const io::LoadProgress& progress) {
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        constexpr double report_threshold = 1.0;  // [s]
        if (passed.count() < report_threshold) {
            return;
        }
        const double done =
            static_cast<double>(progress.images_done) / static_cast<double>(progress.images_total);
        console.task({.fraction = done,
                      .seconds = passed.count(),
                      .seconds_left = passed.count() * (1.0 - done) / done,
                      .activity = fmt::format("loading textures, {}/{}", progress.images_done,
                                              progress.images_total)});
    };
    return arguments;
}

}  // namespace

int run_render(const RenderArguments& asked, const std::vector<std::string>& words)
{
    const std::vector<std::filesystem::path> written = check_files(asked);
    Console console(asked.format, asked.verbosity);
    Interrupt interrupt(
        temporary_paths(written),
        [&console] {
            console.note("stopping after the pass in flight; interrupt again to end at once");
        },
        asked.part ? UserSignal::checkpoint : UserSignal::default_action);
    std::optional<PartKeeper> keeper;
    if (asked.part) {
        keeper.emplace(*asked.part, console);
    }

    const PreparedScene stage = prepare_within_memory(with_progress(asked, console));
    console.end_progress();
    render_view(asked, stage, keeper, {console, interrupt, words});
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : 0;
}

}  // namespace bdpt::app
