#include "options/groups/strategy_arguments.h"

#include <bdpt/eval/bench/option_names.h>
#include <bdpt/integrators.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/number.h"
#include "options/values/output_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

constexpr int greatest_depth = 100;  // beyond, nobody could look at the sheet

}  // namespace

void add_strategy_options(CLI::App& command, StrategyWords& words)
{
    const auto group = "Output";
    command
        .add_option("--strategies", words.file,
                    "Write an image of each strategy (bdpt, lt) to this .exr: layers like s02t03 "
                    "(weighted: its part of the image) and s02t03.unweighted (alone); and a "
                    "contact sheet of all as .png")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--strategy-depth", words.depth,
                    fmt::format("Longest paths, in edges, of --strategies. Default: {}, or fewer "
                                "to stay below 4 GB",
                                default_strategy_depth))
        ->check(whole_number(1, greatest_depth))
        ->type_name("N")
        ->group(group);
}

std::optional<StrategyFiles> strategy_files(const StrategyWords& words,
                                            const RenderOptions& options)
{
    if (!words.file) {
        if (words.depth) {
            reject("--strategy-depth", fmt::format("{}", *words.depth),
                   "--strategies FILE.exr with it");
        }
        return std::nullopt;
    }
    const fs::path file = *words.file;
    if (!has_extension(file, ".exr")) {
        reject("--strategies", *words.file, "a file that is named .exr");
    }
    if (!info(options.integrator).has_strategies) {
        reject("--strategies", *words.file,
               fmt::format("--integrator bdpt or lt with it, not {}",
                           eval::to_string(options.integrator)));
    }
    return StrategyFiles{
        .layers = file, .sheet = fs::path(file).replace_extension(".png"), .depth = words.depth};
}

}  // namespace bdpt::app
