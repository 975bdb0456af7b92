#include "commands/render_command.h"

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands/render_view.h"
#include "options/output_files.h"
#include "report/part_keeper.h"
#include "report/render_files.h"
#include "stage/render_preparation.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {
namespace {

using nlohmann::ordered_json;

/// Of a task that has been done before.
int report_complete(Console& console, const RenderArguments& arguments)
{
    const std::int64_t samples = arguments.samples.end - arguments.samples.begin;
    console.note(fmt::format("{}: has all samples of the task", arguments.part->file.string()));
    console.event("done", {{"samples", samples},
                           {"seconds", 0.0},
                           {"outputs", ordered_json::array()},
                           {"exposure", nullptr},
                           {"stopped_by", nullptr}});
    return 0;
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
        if (keeper->is_complete(asked.samples) && asked.outputs.empty()) {
            return report_complete(console, asked);
        }
    }

    const PreparedScene stage = prepare_within_memory(asked, console);
    console.end_progress();
    render_view(asked, stage, keeper, {console, interrupt, words});
    const std::optional<int> signal = interrupt.signal();
    return signal ? 128 + *signal : 0;
}

}  // namespace bdpt::app
