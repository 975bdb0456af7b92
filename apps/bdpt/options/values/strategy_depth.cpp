#include "options/values/strategy_depth.h"

#include <bdpt/error.h>
#include <bdpt/render.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>

namespace bdpt::app {
namespace {

/// Returns the option by which strategy images were requested.
std::string format_option(const StrategyFiles& files)
{
    return files.layers.empty() ? "--strategy-depth"
                                : fmt::format("--strategies \"{}\"", files.layers.string());
}

double gigabytes(std::uint64_t bytes)
{
    return static_cast<double>(bytes) * 1e-9;
}

std::uint64_t bytes_up_to(int depth, RenderOptions options, const CameraDesc& camera)
{
    options.bidirectional.strategy_depth = depth;
    return strategy_image_bytes(options, camera);
}

/// Returns the greatest depth up to `wanted` whose images fit into memory; 0 if none does.
int affordable_depth(int wanted, const RenderOptions& options, const CameraDesc& camera)
{
    int depth = wanted;
    while (depth > 0 &&
           bytes_up_to(depth, options, camera) > options.bidirectional.strategy_memory) {
        --depth;
    }
    return depth;
}

}  // namespace

StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                             const CameraDesc& camera)
{
    const int wanted =
        std::min(files.depth.value_or(default_strategy_depth), options.transport.max_depth);
    const std::uint64_t bytes = bytes_up_to(wanted, options, camera);
    if (bytes == 0) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: no enabled strategy samples paths of up to {} edges "
                                "(--strategy-depth)",
                                format_option(files), wanted));
    }
    const int depth = affordable_depth(wanted, options, camera);
    if (depth == wanted) {
        return {.edges = wanted, .warning = {}};
    }
    const std::string figures = fmt::format(
        "{}: images of paths of up to {} edges take {:.1f} GB, more than the limit of {:.1f} GB",
        format_option(files), wanted, gigabytes(bytes),
        gigabytes(options.bidirectional.strategy_memory));
    const bool any = depth > 0 && bytes_up_to(depth, options, camera) > 0;
    if (files.depth || !any) {
        throw Error(ErrorCode::usage,
                    figures + (any ? fmt::format("; --strategy-depth {} takes less", depth)
                                   : "; a smaller --size or --crop takes less"));
    }
    return {.edges = depth,
            .warning = fmt::format("{}: only those of up to {} edges are written "
                                   "(--strategy-depth)",
                                   figures, depth)};
}

}  // namespace bdpt::app
