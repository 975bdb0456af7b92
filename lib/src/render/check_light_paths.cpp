#include "render/check_light_paths.h"

#include "integrator/bidirectional/light_path_cache.h"
#include "render/megabytes.h"

#include <bdpt/error.h>
#include <bdpt/options/integrators.h>
#include <bdpt/render.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

namespace bdpt {
namespace {

std::string text(double number)
{
    std::ostringstream stream;
    stream << number;
    return stream.str();
}

void check_merging(const RenderOptions& options)
{
    const Heuristic heuristic = options.transport.heuristic;
    if (options.bidirectional.light_paths == 0.0) {
        throw Error(ErrorCode::usage, "light_paths is 0, but vcm needs light paths");
    }
    if (heuristic != Heuristic::power && heuristic != Heuristic::balance) {
        throw Error(ErrorCode::usage, "vcm needs the heuristic power or balance");
    }
}

}  // namespace

void check_light_paths(const RenderOptions& options)
{
    const double light_paths = options.bidirectional.light_paths;
    const double connections = options.bidirectional.connections.value_or(0.0);
    if (light_paths == 0.0 && options.integrator == IntegratorKind::lt) {
        throw Error(ErrorCode::usage, "light_paths is 0, but lt needs light paths");
    }
    if (options.integrator == IntegratorKind::vcm) {
        check_merging(options);
    }
    if (light_paths == 0.0 && connections > 0.0) {
        throw Error(ErrorCode::usage,
                    "connections is " + text(connections) + ", but light_paths is 0");
    }
    const double rays = options.bidirectional.connection_rays;
    const LightPathCounts counts(options);
    const bool whole = counts.connections == std::floor(counts.connections);
    if (rays > 0.0 && !(whole && counts.connections >= 1.0)) {
        throw Error(ErrorCode::usage, "connection_rays is " + text(rays) + ", but connections is " +
                                          text(counts.connections) +
                                          ", not a whole number above 0");
    }
    const std::uint64_t bytes = light_path_bytes(options);
    if (bytes > options.bidirectional.light_path_memory) {
        throw Error(ErrorCode::usage,
                    text(light_paths) + " shared light paths for each camera path (light_paths) " +
                        "may take " + megabytes(bytes) +
                        ", more than the limit (light_path_memory) of " +
                        megabytes(options.bidirectional.light_path_memory) +
                        ": use fewer, a smaller image or a larger limit");
    }
}

std::uint64_t light_path_bytes(const RenderOptions& options)
{
    return info(options.integrator).traces_light_paths
               ? LightPathCache::bytes(LightPathCounts(options),
                                       LightPathCache::usual_vertices(options))
               : 0;
}

}  // namespace bdpt
