#include "render/check_options.h"

#include "geometry/placed_mesh.h"
#include "integrator/bidirectional/light_path_cache.h"
#include "math/elementary.h"
#include "scene/checks/value_checks.h"

#include <bdpt/error.h>
#include <bdpt/motion.h>
#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/options/option_text.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace bdpt {
namespace {

void check_crop(const PixelRect& crop, int width, int height)
{
    const bool inside = crop.x0 >= 0 && crop.y0 >= 0 && crop.x1 <= width && crop.y1 <= height;
    if (!inside || crop.x0 >= crop.x1 || crop.y0 >= crop.y1) {
        throw Error(ErrorCode::usage,
                    "crop " + std::to_string(crop.x0) + "," + std::to_string(crop.y0) + "," +
                        std::to_string(crop.x1) + "," + std::to_string(crop.y1) +
                        " is empty or outside of the image of " + std::to_string(width) + "x" +
                        std::to_string(height) + " pixels");
    }
}

void check_rates(const RenderOptions& options)
{
    const SampleRates* rates = options.sampling.rates.get();
    if (rates == nullptr) {
        return;
    }
    if (rates->width() != options.film.width || rates->height() != options.film.height) {
        throw Error(ErrorCode::usage, "rates of samples are those of an image of " +
                                          std::to_string(rates->width()) + "x" +
                                          std::to_string(rates->height()) + " pixels, not of " +
                                          std::to_string(options.film.width) + "x" +
                                          std::to_string(options.film.height));
    }
    check_takes_rates(options.integrator);
    const SampleRange& samples = options.sampling.samples;
    check_range("last round with rates of samples", samples.end, 1, SampleRates::max_rounds);
    for (const std::int64_t border : {samples.begin, samples.end}) {
        if (border % SampleRates::group != 0) {
            throw Error(
                ErrorCode::usage,
                "samples begin or end at " + std::to_string(border) +
                    ", but with rates of samples (adaptive sampling) only at multiples of " +
                    std::to_string(SampleRates::group));
        }
    }
}

[[noreturn]] void fail_range(std::string_view name, const Range& range, const std::string& value)
{
    throw Error(ErrorCode::usage, std::string(name) + " is " + value + ", not in " +
                                      (range.low_is_excluded ? "(" : "[") + option_text(range.low) +
                                      ", " + option_text(range.high) + "]");
}

/// Tests a float range with its ends as floats: 0.01 as a float is less than 0.01.
bool is_in(const Range& range, float value)
{
    const auto low = static_cast<float>(range.low);
    const auto high = static_cast<float>(range.high);
    return (range.low_is_excluded ? value > low : value >= low) && value <= high;
}

template <typename T>
bool is_in(const Range& range, T value)
{
    return range.contains(static_cast<double>(value));
}

/// Checks the values of an option whose numbers have that range.
template <typename T>
void check_value(std::string_view name, const Range& range, const T& value)
{
    if constexpr (std::is_arithmetic_v<T>) {
        if (!is_in(range, value)) {
            fail_range(name, range, option_text(value));
        }
    } else if constexpr (std::is_same_v<T, FilterOptions>) {
        check_value("filter radius", range, value.radius.value_or(default_radius(value.kind)));
    } else if constexpr (std::is_same_v<T, std::vector<Strategy>>) {
        for (const Strategy& strategy : value) {
            check_value(std::string(name) + ": s", range, strategy.s);
            check_value(std::string(name) + ": t", range, strategy.t);
        }
    } else if constexpr (requires { value.has_value(); }) {
        if (value) {
            check_value(name, range, *value);
        }
    }
}

void check_within_limit(const std::string& item, const char* what, float value)
{
    if (!(std::abs(value) <= max_coordinate)) {
        fail(item, ": ", what, " is ", std::to_string(value), " m, beyond what rays reach");
    }
}

/// Checks the pose of a camera called `item`.
void check_pose(const std::string& item, const Mat4& world_from_camera)
{
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(world_from_camera[column][row])) {
                fail(item, ": transform is not finite");
            }
        }
    }
    for (int row = 0; row < 3; ++row) {
        check_within_limit(item, "position", world_from_camera[3][row]);
    }
    const Vec3 side = cross(Vec3(world_from_camera[1]), Vec3(world_from_camera[2]));
    if (!(dot(side, side) > 0.0f)) {
        fail(item, ": transform has no inverse");
    }
}

void check_motion(const std::string& item, const CameraDesc& camera)
{
    if (camera.motion.size() > max_time_steps) {
        fail(item, ": motion of ", camera.motion.size(), " steps, but ", max_time_steps,
             " is the most");
    }
    for (std::size_t i = 0; i < camera.motion.size(); ++i) {
        const std::string step = item + ": motion, step " + std::to_string(i);
        check_pose(step, camera.motion[i]);
        if (!can_move(i == 0 ? camera.world_from_camera : camera.motion[i - 1], camera.motion[i])) {
            fail(step, ": an interpolated transform before it has no inverse; use more steps");
        }
    }
}

std::string label(const CameraDesc& camera)
{
    return camera.name.empty() ? std::string("camera") : "camera \"" + camera.name + "\"";
}

}  // namespace

void check_range(const char* what, std::int64_t value, std::int64_t low, std::int64_t high)
{
    if (value < low || value > high) {
        throw Error(ErrorCode::usage, std::string(what) + " is " + std::to_string(value) +
                                          ", not in [" + std::to_string(low) + ", " +
                                          std::to_string(high) + "]");
    }
}

void check_options(const RenderOptions& options)
{
    for_each_option(options, [](const auto& option, const auto& value) {
        check_value(option.name, option.info.range, value);
    });
    if (options.film.crop) {
        check_crop(*options.film.crop, options.film.width, options.film.height);
    }
    // The film's record of defects has sample indices of 32 bits.
    check_range("first sample", options.sampling.samples.begin, 0,
                std::numeric_limits<std::uint32_t>::max());
    check_range("number of samples", options.sampling.samples.end - options.sampling.samples.begin,
                1, std::numeric_limits<std::uint32_t>::max() - options.sampling.samples.begin);
    check_range("min_depth", options.transport.min_depth, 1, options.transport.max_depth);
    if (options.bidirectional.strategy_depth > 0 && !info(options.integrator).has_strategies) {
        throw Error(ErrorCode::usage,
                    "images of strategies (strategy_depth) need the integrator bdpt or lt");
    }
    check_light_paths(options);
    check_rates(options);
}

void check_takes_rates(IntegratorKind integrator)
{
    if (integrator == IntegratorKind::lt || integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage, "rates of samples cannot be combined with the integrator " +
                                          std::string(info(integrator).name));
    }
}

void check_camera(const CameraDesc& camera)
{
    const std::string item = label(camera);
    check_pose(item, camera.world_from_camera);
    check_motion(item, camera);
    const auto check_length = [&](const char* what, float value, bool zero_is_fine) {
        if (!(value > 0.0f || (zero_is_fine && value == 0.0f)) || !std::isfinite(value)) {
            fail(item, ": ", what, " is ", std::to_string(value), " m");
        }
    };
    check_length("lens radius", camera.lens_radius, true);
    check_length("focus distance", camera.focus_distance, false);
    check_length("vertical extent", camera.vertical_extent, false);
    check_within_limit(item, "lens radius", camera.lens_radius);
    check_within_limit(item, "vertical extent", camera.vertical_extent);
    if (!(camera.vertical_fov > 0.0f && camera.vertical_fov < pi)) {
        fail(item, ": vertical field of view is ", std::to_string(camera.vertical_fov),
             " rad, not in (0, pi)");
    }
    check_own_limits(item, camera);
}

void check_camera_distance(const CameraDesc& camera, float farthest)
{
    const auto check = [&](const Mat4& world_from_camera) {
        const Vec3 position = abs(Vec3(world_from_camera[3]));
        const float distance = std::max({position.x, position.y, position.z});
        if (!(distance <= farthest)) {
            fail(label(camera), ": is ", distance, " m from the origin, but ", farthest,
                 " m is the most in this scene, because an instanced or moving mesh is scaled "
                 "down very much");
        }
    };
    check(camera.world_from_camera);
    for (const Mat4& later : camera.motion) {
        check(later);
    }
}

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
