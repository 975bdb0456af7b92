#include "render/strategy_images.h"

#include "path/strategy_set.h"
#include "render/check_options.h"

#include <bdpt/error.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace bdpt {
namespace {

/// Tests whether the camera supports a strategy: only a finite lens can be hit, and s = t = 1 needs
/// a perspective camera.
bool camera_allows(const CameraDesc& camera, Strategy strategy)
{
    const bool perspective = camera.projection == Projection::perspective;
    if (strategy.t == 0) {
        return perspective && camera.lens_radius > 0.0f;
    }
    return perspective || strategy != Strategy{.s = 1, .t = 1};
}

}  // namespace

std::vector<Strategy> strategies_with_images(const RenderOptions& options, const CameraDesc& camera)
{
    std::vector<Strategy> result;
    if (options.bidirectional.strategy_depth == 0) {
        return result;
    }
    const StrategySet used(options);
    const int longest = std::min(options.bidirectional.strategy_depth, options.transport.max_depth);
    for (int edges = 1; edges <= longest; ++edges) {
        for (int s = 0; s <= edges + 1; ++s) {
            const Strategy strategy{.s = s, .t = edges + 1 - s};
            if (used.uses(s, strategy.t) && camera_allows(camera, strategy)) {
                result.push_back(strategy);
            }
        }
    }
    return result;
}

std::uint64_t strategy_image_bytes(const RenderOptions& options, const CameraDesc& camera)
{
    check_options(options);
    const PixelRect region = options.film.crop.value_or(
        PixelRect{.x0 = 0, .y0 = 0, .x1 = options.film.width, .y1 = options.film.height});
    return StrategyFilm::bytes_per_pixel * static_cast<std::uint64_t>(region.width()) *
           static_cast<std::uint64_t>(region.height()) *
           strategies_with_images(options, camera).size();
}

void check_strategy_memory(const RenderOptions& options, const CameraDesc& camera)
{
    const std::uint64_t bytes = strategy_image_bytes(options, camera);
    if (bytes > options.bidirectional.strategy_memory) {
        throw Error(ErrorCode::usage, "images of strategies up to " +
                                          std::to_string(options.bidirectional.strategy_depth) +
                                          " edges (strategy_depth) take " + megabytes(bytes) +
                                          ", more than the limit (strategy_memory) of " +
                                          megabytes(options.bidirectional.strategy_memory));
    }
}

}  // namespace bdpt
