#include "options/groups/strategy_arguments.h"

#include <bdpt/eval/bench/option_names.h>
#include <bdpt/integrators.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/output_files.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* output_group = "Output";
constexpr int greatest_depth = 100;  // beyond, nobody could look at the sheet

}  // namespace

void add_strategy_options(CLI::App& command, StrategyWords& words)
{
    add_strategy_file_option(
        command, words.file,
        "Write an image of each strategy (bdpt, lt) to this .exr: layers like s02t03 (weighted: "
        "its part of the image) and s02t03.unweighted (alone); and a contact sheet of all as .png");
    command
        .add_option("--strategy-depth", words.depth,
                    fmt::format("Longest paths, in edges, of --strategies. Default: {}, or fewer "
                                "to stay below 4 GB. With --part alone: keep these images in the "
                                "part",
                                default_strategy_depth))
        ->check(whole_number(1, greatest_depth))
        ->type_name("N")
        ->group(output_group);
}

void add_strategy_file_option(CLI::App& command, std::optional<std::string>& file,
                              const char* description)
{
    command.add_option("--strategies", file, description)->type_name("FILE")->group(output_group);
}

StrategyFiles strategy_files(const std::string& file)
{
    if (!has_extension(file, ".exr")) {
        reject("--strategies", file, "a file that is named .exr");
    }
    return {.layers = file, .sheet = fs::path(file).replace_extension(".png")};
}

std::optional<StrategyFiles> strategy_files(const StrategyWords& words,
                                            const RenderOptions& options, const PartWords& part)
{
    if (!words.file && !words.depth) {
        return std::nullopt;
    }
    if (!words.file && !part.file) {
        reject("--strategy-depth", fmt::format("{}", *words.depth),
               "--strategies FILE.exr or --part FILE with it");
    }
    StrategyFiles result = words.file ? strategy_files(*words.file) : StrategyFiles{};
    result.depth = words.depth;
    if (!info(options.integrator).has_strategies) {
        reject(words.file ? "--strategies" : "--strategy-depth",
               words.file.value_or(fmt::format("{}", words.depth.value_or(0))),
               fmt::format("--integrator bdpt or lt with it, not {}",
                           eval::to_string(options.integrator)));
    }
    return result;
}

std::vector<fs::path> StrategyFiles::both() const
{
    return layers.empty() ? std::vector<fs::path>() : std::vector<fs::path>{layers, sheet};
}

}  // namespace bdpt::app
