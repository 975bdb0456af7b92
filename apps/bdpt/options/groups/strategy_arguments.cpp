#include "options/groups/strategy_arguments.h"

#include <bdpt/options/integrators.h>
#include <fmt/core.h>

#include <array>
#include <utility>

#include "options/values/output_files.h"
#include "options/values/value_types.h"

namespace bdpt::app {

namespace fs = std::filesystem;

void add_strategy_options(OptionList& options, StrategyFiles& strategies)
{
    add_strategy_file_option(
        options, strategies,
        "Write an image of each strategy (bdpt, lt) to this .exr: layers like s02t03 "
        "(MIS-weighted: its part of the image) and s02t03.unweighted, and a .png contact sheet of "
        "all");
    constexpr int most = 100;  // larger sheets are unreadable
    Option& depth =
        options.add("--strategy-depth", "N",
                    fmt::format("Maximum path length, in edges, of --strategies. Default: {}, or "
                                "less to stay below 4 GB. With --part alone: keep these images in "
                                "the part",
                                default_strategy_depth),
                    strategies.depth, whole_number(1, most));
    depth.uses = {};
}

void add_strategy_file_option(OptionList& options, StrategyFiles& strategies, std::string help)
{
    const auto parse = [](const std::string& text) -> std::optional<StrategyFiles> {
        if (!has_extension(text, ".exr")) {
            return std::nullopt;
        }
        return StrategyFiles::named(text);
    };
    Option& option = options.add("--strategies", "FILE", std::move(help), strategies,
                                 parsed_by(parse, "a file name that ends in .exr"));
    option.uses = {.stated_in = StatedIn::own_folder};
    option.info.is_path = true;
}

std::optional<StrategyFiles> checked(const StrategyFiles& strategies, const RenderOptions& render,
                                     const OptionList& options)
{
    if (options.find("--strategies") == nullptr) {
        return std::nullopt;  // bench: its --strategy-depth is a different option
    }
    const bool file = options.given("--strategies");
    if (!file && !options.given("--strategy-depth")) {
        return std::nullopt;
    }
    static constexpr std::array needs{Need{"--strategy-depth", "--strategies|--part"}};
    check(needs, options);
    if (!info(render.integrator).has_strategies) {
        throw OptionError(fmt::format("{} needs --integrator bdpt or lt, not {}",
                                      file ? "--strategies" : "--strategy-depth",
                                      info(render.integrator).name));
    }
    return strategies;
}

StrategyFiles StrategyFiles::named(const fs::path& layers)
{
    return {.layers = layers, .sheet = fs::path(layers).replace_extension(".png")};
}

std::vector<fs::path> StrategyFiles::both() const
{
    return layers.empty() ? std::vector<fs::path>() : std::vector<fs::path>{layers, sheet};
}

}  // namespace bdpt::app
